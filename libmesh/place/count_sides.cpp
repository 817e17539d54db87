#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/intersect/point_locator.hpp>
#include <libmesh/place/point_sides.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/tree/detail/morton_order.hpp>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

namespace treeform {
namespace {

/// Numbers of the points in the closed box.
std::vector<std::uint32_t> points_in(const box3& box, points_view points) {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        bool within = true;
        for (std::size_t k = 0; k < 3; ++k)
            within = within && box.min[k] <= points[i][k] && points[i][k] <= box.max[k];
        if (within) numbers.push_back(i);
    }
    return numbers;
}

void lower_sides(const prepared_mesh& solid, points_view points, std::vector<std::int8_t>& side) {
    const mesh_view mesh = solid.view();
    const auto box = bounding_box(mesh.points);
    if (mesh.faces.empty() || solid.is_cloud() || !box) return;
    const auto numbers = points_in(*box, points);
    if (numbers.empty() || !detail::intersect::is_closed(solid)) return;
    const auto order = detail::morton_order<3>(numbers.size(), [&](std::size_t i) {
        const point3& p = points[numbers[i]];
        return std::array<double, 3>{p.x, p.y, p.z};
    });
    std::vector<point3> queries;
    for (const std::uint32_t i : order) queries.push_back(points[numbers[i]]);
    const std::vector<double> unknown(queries.size());
    const auto found = detail::place::sides_in_order(mesh, build_face_tree(solid, "count_sides"),
                                                     queries, unknown, 0.0);
    for (std::size_t i = 0; i < order.size(); ++i) {
        std::int8_t& one = side[numbers[order[i]]];
        one = std::min(one, found.side[i]);
    }
}

}  // namespace

side_counts count_sides(points_view points, std::span<const prepared_mesh> solids) {
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!detail::base::is_finite(points[i]))
            throw std::invalid_argument("treeform::count_sides: point " + std::to_string(i) +
                                        " is not finite");
    std::vector<std::int8_t> side(points.size(), 1);
    for (const prepared_mesh& solid : solids) lower_sides(solid, points, side);
    side_counts counts;
    for (const std::int8_t one : side)
        ++(one < 0 ? counts.inside : one == 0 ? counts.on : counts.outside);
    return counts;
}

}  // namespace treeform
