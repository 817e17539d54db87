#include <libmesh/carry/face_shares.hpp>

#include <algorithm>
#include <cmath>

namespace treeform::detail::carry {
namespace {

point3 difference(const point3& p, const point3& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }

point3 cross(const point3& u, const point3& v) {
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

double dot(const point3& u, const point3& v) { return u.x * v.x + u.y * v.y + u.z * v.z; }

}  // namespace

shares_of_corners shares_at(const point3& p, const point3& a, const point3& b, const point3& c) {
    const point3 normal = cross(difference(b, a), difference(c, a));
    const point3 to_a = difference(a, p), to_b = difference(b, p), to_c = difference(c, p);
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
    const point3 edge = difference(b, a);
    const double share = dot(difference(p, a), edge) / dot(edge, edge);
    return std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0;
}

point3 normal_of(const mesh& mesh, const face& f) {
    const point3 &a = mesh.points[f[0]], &b = mesh.points[f[1]], &c = mesh.points[f[2]];
    return cross(difference(b, a), difference(c, a));
}

point3 with_length_one(const point3& v) {
    const double length = std::sqrt(dot(v, v));
    return length > 0.0 ? point3{v.x / length, v.y / length, v.z / length} : v;
}

bool is_turned(const point3& normal, const point3& other) { return dot(normal, other) < 0.0; }

}  // namespace treeform::detail::carry
