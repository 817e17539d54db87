#include "bench/exact_solid.hpp"

#include <libmesh/exact/implicit_point.hpp>
#include <libmesh/nearness/closest_point_query.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/mesh.hpp>

#include <support/rational_volume.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::bench {
namespace {

/// The faces that bound what the expression makes, with the points they have.
mesh boundary_of(const test::exact_arrangement& arranged, const boolean_expression& expression) {
    constexpr std::uint32_t none = 0xFFFFFFFF;
    const mesh_arrangement& cut = arranged.cut();
    std::vector<std::uint32_t> number(cut.given_points.size() + cut.constructed.size(), none);
    mesh result;
    for (std::size_t f = 0; f < cut.faces.size(); ++f) {
        if (arranged.sign(f, expression) == 0) continue;
        face corners = cut.faces[f];
        for (std::uint32_t& c : corners) {
            if (number[c] == none) {
                number[c] = static_cast<std::uint32_t>(result.points.size());
                result.points.push_back(rounded(cut.point(c)));
            }
            c = number[c];
        }
        result.faces.push_back(corners);
    }
    return result;
}

std::vector<point3> corners_of(const mesh& m) {
    std::vector<std::uint8_t> used(m.points.size(), 0);
    for (const face& f : m.faces)
        for (const std::uint32_t c : f) used[c] = 1;
    std::vector<point3> corners;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v] != 0) corners.push_back(m.points[v]);
    return corners;
}

double furthest(const mesh& from, const mesh& to) {
    const std::vector<point3> corners = corners_of(from);
    const auto nearest = detail::nearness::closest_point_query(to).nearest(std::span(corners));
    double largest = 0.0;
    for (const auto& one : nearest) largest = std::max(largest, one->distance);
    return largest;
}

}  // namespace

std::optional<exact_solid> exact_solid_of(std::span<const mesh> operands,
                                          const boolean_expression& expression) {
    const test::exact_arrangement arranged(operands);
    if (!arranged.closed()) return {};
    const auto volumes = test::exact_volumes(arranged, std::array{expression});
    return exact_solid{mpq_class(volumes[0]), boundary_of(arranged, expression)};
}

double corner_distance(const mesh& found, const mesh& exact) {
    if (found.faces.empty() && exact.faces.empty()) return 0.0;
    if (found.faces.empty() || exact.faces.empty()) return 1.0;
    const box3 box = bounding_box(exact.points).value();
    double squared = 0.0, reach = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        squared += (box.max[k] - box.min[k]) * (box.max[k] - box.min[k]);
        reach = std::max({reach, std::abs(box.min[k]), std::abs(box.max[k])});
    }
    const double diagonal = std::sqrt(squared);
    const double measured = std::max(furthest(found, exact), furthest(exact, found));
    // 16 u L and u of a coordinate of the query, half a unit in each coordinate of a corner.
    const double room = 0x1p-53 * (16 * std::max(measured, diagonal) + 4 * reach);
    return (measured + room) / diagonal;
}

}  // namespace treeform::bench
