#include <libmesh/intersect/detail/same_points.hpp>
#include <libtree/build.hpp>
#include <libtree/search_self.hpp>

#include <cmath>
#include <cstddef>
#include <limits>

namespace tf::detail {
namespace {

/// The ball's box, rounded outward.
aabb<double, 3> box_of(const constructed_point& p) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    point3 low = p.centre();
    point3 high = p.centre();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::nextafter(low[axis] - p.radius(), -infinity);
        high[axis] = std::nextafter(high[axis] + p.radius(), infinity);
    }
    aabb<double, 3> box;
    box.include(low);
    box.include(high);
    return box;
}

bool boxes_meet(const constructed_point& p, const constructed_point& q) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (std::abs(p.centre()[axis] - q.centre()[axis]) >
            (p.radius() + q.radius()) * (1.0 + 0x1p-50) + 0x1p-1070)
            return false;
    return true;
}

}  // namespace

std::vector<std::pair<std::uint32_t, std::uint32_t>> equal_pairs(
    std::span<const constructed_point> points) {
    const tree<3> balls = build(points, box_of);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> result;
    for (const id_pair& pair : search_self_all(balls, [&](std::uint32_t a, std::uint32_t b) {
             return boxes_meet(points[a], points[b]) && equal(points[a], points[b]);
         }))
        result.emplace_back(pair.first, pair.second);
    return result;
}

}  // namespace tf::detail
