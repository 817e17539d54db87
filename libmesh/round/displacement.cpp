#include <libmesh/base/point_math.hpp>
#include <libmesh/nearness/closest_point_query.hpp>
#include <libmesh/round/displacement.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace treeform::detail::round {

/// Of a coordinate, by which the nearest places are rounded.
constexpr double unit = 0x1p-52;

double displacement(points_view now, std::span<const std::uint32_t> point_of, mesh_view before) {
    double most = 0.0;
    const auto include = [&](const point3& here, const point3& there) {
        most = std::max(most, base::largest_of(base::minus(here, there)));
    };
    std::vector<point3> made;
    for (std::size_t p = 0; p < now.size(); ++p) {
        if (point_of[p] < before.points.size())
            include(now[p], before.points[point_of[p]]);
        else
            made.push_back(now[p]);
    }
    if (made.empty()) return most;
    const auto nearest = nearness::closest_point_query(before).nearest(made);
    double largest = 0.0;
    for (std::size_t p = 0; p < made.size(); ++p) {
        largest = std::max(largest, base::largest_of(made[p]));
        if (nearest[p]) include(made[p], nearest[p]->point);
    }
    return most + unit * largest;
}

}  // namespace treeform::detail::round
