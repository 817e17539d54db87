#include <libmesh/base/point_math.hpp>
#include <libmesh/base/used_points.hpp>
#include <libmesh/nearness/closest_point_query.hpp>
#include <libmesh/round/displacement.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace treeform::detail::round {

namespace {

/// Of a coordinate, by which the nearest places are rounded.
constexpr double unit = 0x1p-52;

double farthest(const std::vector<point3>& points, mesh_view from) {
    if (points.empty() || from.faces.empty()) return 0.0;
    const auto nearest = nearness::closest_point_query(from).nearest(points);
    double most = 0.0, largest = 0.0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        largest = std::max(largest, base::largest_of(points[p]));
        if (!nearest[p]) continue;
        most = std::max(most, base::largest_of(base::minus(points[p], nearest[p]->point)));
    }
    return most + unit * largest;
}

}  // namespace

surface_moves displacement(mesh_view now, std::span<const std::uint32_t> point_of,
                           mesh_view before) {
    surface_moves result;
    std::vector<point3> made, gone;
    std::vector<std::uint8_t> stays(before.points.size(), 0);
    for (std::size_t p = 0; p < now.points.size(); ++p) {
        const std::uint32_t was = point_of[p];
        if (was >= before.points.size()) {
            made.push_back(now.points[p]);
            continue;
        }
        stays[was] = 1;
        result.moved = std::max(result.moved,
                                base::largest_of(base::minus(now.points[p], before.points[was])));
    }
    for (const std::uint32_t p : base::used_points(before.points.size(), before.faces))
        if (stays[p] == 0) gone.push_back(before.points[p]);
    result.moved = std::max(result.moved, farthest(made, before));
    result.gone = farthest(gone, now);
    return result;
}

}  // namespace treeform::detail::round
