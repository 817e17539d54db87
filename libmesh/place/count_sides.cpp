#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/intersect/point_locator.hpp>
#include <libmesh/place/point_sides.hpp>
#include <treeform/mesh/measure.hpp>

#include <algorithm>
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
    std::vector<point3> within;
    within.reserve(numbers.size());
    for (const std::uint32_t i : numbers) within.push_back(points[i]);
    const auto found = detail::place::sides_of(mesh, build_face_tree(solid, "count_sides"), within);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        side[numbers[i]] = std::min(side[numbers[i]], found[i]);
}

}  // namespace

std::array<std::uint64_t, 3> count_sides(points_view points, const mesh_refs& given_solids) {
    const detail::base::prepared_refs all_solids(given_solids);
    const std::span<const prepared_mesh> solids = all_solids;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!detail::base::is_finite(points[i]))
            throw std::invalid_argument("treeform::count_sides: point " + std::to_string(i) +
                                        " is not finite");
    std::vector<std::int8_t> side(points.size(), 1);
    for (const prepared_mesh& solid : solids) lower_sides(solid, points, side);
    std::array<std::uint64_t, 3> counts{};
    for (const std::int8_t one : side) ++counts[static_cast<std::size_t>(one + 1)];
    return counts;
}

}  // namespace treeform
