#include <libmesh/base/point_math.hpp>
#include <libmesh/carry/face_shares.hpp>

#include <algorithm>
#include <cmath>

namespace treeform::detail::carry {
namespace {

using base::cross;
using base::dot;
using base::minus;

}  // namespace

shares_of_corners shares_at(const point3& p, const point3& a, const point3& b, const point3& c) {
    const point3 normal = cross(minus(b, a), minus(c, a));
    const point3 to_a = minus(a, p), to_b = minus(b, p), to_c = minus(c, p);
    std::array<double, 3> w{dot(normal, cross(to_b, to_c)), dot(normal, cross(to_c, to_a)),
                            dot(normal, cross(to_a, to_b))};
    double sum = 0.0, outside = 0.0;
    for (double& one : w) {
        outside += std::max(-one, 0.0);
        sum += one = std::max(one, 0.0);
    }
    if (!(sum > 0.0) || !std::isfinite(sum) || !std::isfinite(outside)) return {};
    for (double& one : w) one /= sum;
    return {w, outside / sum};
}

double share_along(const point3& p, const point3& a, const point3& b) {
    const point3 edge = minus(b, a);
    const double share = dot(minus(p, a), edge) / dot(edge, edge);
    return std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0;
}

point3 normal_of(const mesh& mesh, const face& f) {
    const point3 &a = mesh.points[f[0]], &b = mesh.points[f[1]], &c = mesh.points[f[2]];
    return cross(minus(b, a), minus(c, a));
}

point3 with_length_one(const point3& v) {
    const double length = std::sqrt(dot(v, v));
    return length > 0.0 ? point3{v.x / length, v.y / length, v.z / length} : v;
}

bool is_turned(const point3& normal, const point3& other) { return dot(normal, other) < 0.0; }

}  // namespace treeform::detail::carry
