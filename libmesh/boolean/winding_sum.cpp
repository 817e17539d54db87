#include <libmesh/base/point_math.hpp>
#include <libmesh/boolean/winding_sum.hpp>
#include <libmesh/geometry/solid_angle.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace treeform::detail::boolean {
namespace {

using base::minus;
using base::plus;
using base::scaled;

constexpr std::size_t faces_in_leaf = 4;
constexpr double far = 2.0;  // radii from which on a dipole will do

double length(const point3& v) { return std::sqrt(base::dot(v, v)); }

}  // namespace

winding_sum::winding_sum(mesh_view mesh, const std::vector<double>& times)
    : mesh_(mesh), times_(times) {
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        if (times[f] != 0.0) order_.push_back(f);
    if (!order_.empty()) build(0, order_.size());
}

point3 winding_sum::middle_of(std::uint32_t f) const {
    const auto [a, b, c] = base::triangle_of(mesh_.points, mesh_.faces[f]);
    return scaled(plus(plus(a, b), c), 1.0 / 3.0);
}

/// Halves by the middles of faces, along the axis in which these extend most; equal ones by number,
/// so that the tree is the same whatever sorts.
void winding_sum::build(std::size_t begin, std::size_t end) {
    const std::size_t own = nodes_.size();
    nodes_.push_back({begin, end});
    measure(nodes_[own]);
    if (end - begin > faces_in_leaf) {
        point3 least = middle_of(order_[begin]), most = least;
        for (std::size_t i = begin; i < end; ++i) {
            const point3 middle = middle_of(order_[i]);
            for (std::size_t k = 0; k < 3; ++k) {
                least[k] = std::min(least[k], middle[k]);
                most[k] = std::max(most[k], middle[k]);
            }
        }
        const point3 extent = minus(most, least);
        std::size_t axis = 0;
        for (const std::size_t k : {std::size_t{1}, std::size_t{2}})
            if (extent[k] > extent[axis]) axis = k;
        std::vector<std::pair<double, std::uint32_t>> keys;
        keys.reserve(end - begin);
        for (std::size_t i = begin; i < end; ++i)
            keys.emplace_back(middle_of(order_[i])[axis], order_[i]);
        std::ranges::sort(keys);
        for (std::size_t i = begin; i < end; ++i) order_[i] = keys[i - begin].second;
        const std::size_t half = begin + (end - begin) / 2;
        build(begin, half);
        build(half, end);
    }
    nodes_[own].skip = nodes_.size();
}

void winding_sum::measure(node& n) const {
    double area = 0.0;
    for (std::size_t i = n.begin; i < n.end; ++i) {
        const std::uint32_t f = order_[i];
        const auto [a, b, c] = base::triangle_of(mesh_.points, mesh_.faces[f]);
        const point3 normal = scaled(base::cross(minus(b, a), minus(c, a)), 0.5);
        const double here = length(normal);
        n.middle = plus(n.middle, scaled(middle_of(f), here));
        n.dipole = plus(n.dipole, scaled(normal, times_[f]));
        area += here;
    }
    n.middle = area > 0.0 ? scaled(n.middle, 1.0 / area) : middle_of(order_[n.begin]);
    for (std::size_t i = n.begin; i < n.end; ++i)
        for (const std::uint32_t p : mesh_.faces[order_[i]])
            n.radius = std::max(n.radius, length(minus(mesh_.points[p], n.middle)));
}

double winding_sum::sum_of(const node& n, const point3& q, std::uint32_t left_out) const {
    double sum = 0.0;
    for (std::size_t i = n.begin; i < n.end; ++i) {
        const std::uint32_t f = order_[i];
        if (f == left_out) continue;
        const auto [a, b, c] = base::triangle_of(mesh_.points, mesh_.faces[f]);
        sum += times_[f] * geometry::solid_angle(minus(a, q), minus(b, q), minus(c, q));
    }
    return sum;
}

double winding_sum::around(const point3& q, std::uint32_t left_out) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < nodes_.size();) {
        const node& n = nodes_[i];
        const point3 toward = minus(n.middle, q);
        const double distance = length(toward);
        if (distance > far * n.radius) {
            sum += base::dot(n.dipole, toward) / (distance * distance * distance);
            i = n.skip;
        } else if (n.end - n.begin <= faces_in_leaf) {
            sum += sum_of(n, q, left_out);
            i = n.skip;
        } else {
            ++i;
        }
    }
    return sum / geometry::full_solid_angle;
}

}  // namespace treeform::detail::boolean
