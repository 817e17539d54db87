#pragma once
/// \file
/// The exact surface of a set operation, found in two ways: by cutting all faces, and by leaving out
/// what is hidden, however little that is.

#include <libmesh/arrange/arrange_pairs.hpp>
#include <libmesh/boolean/active_cells.hpp>
#include <libmesh/boolean/active_space.hpp>
#include <libmesh/boolean/joined_operands.hpp>
#include <libmesh/boolean/operand_edges.hpp>
#include <libmesh/boolean/partial_expression.hpp>
#include <libmesh/boolean/surface_components.hpp>
#include <libmesh/round/solid_faces.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/tf.hpp>

#include <support/exact_chain.hpp>
#include <support/rational_volume.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace test {

/// All faces are cut along each other, and each cell is asked about by itself.
/// \pre each operand bounds a solid
inline exact_chain surface_of_all(std::span<const tf::mesh> operands,
                                  const tf::boolean_expression& expression, tf::fill_rule rule,
                                  exact_numbers& numbers) {
    const exact_arrangement arranged(operands, rule);
    std::vector<tf::triangle3> given;
    for (const tf::mesh& operand : operands)
        for (const auto& [a, b, c] : operand.faces)
            given.push_back({operand.points[a], operand.points[b], operand.points[c]});
    const tf::mesh_arrangement& cut = arranged.cut();
    exact_chain chain;
    for (std::size_t f = 0; f < cut.faces.size(); ++f) {
        const int sign = arranged.sign(f, expression);
        const auto& [a, b, c] = cut.faces[f];
        if (sign != 0)
            add(chain, numbers, {cut.point(a), cut.point(b), cut.point(c)},
                given[cut.covers_of(f).front().face], sign);
    }
    return chain;
}

struct surface_of_some {
    exact_chain chain{};
    std::size_t left_out = 0;  ///< faces
    std::size_t uncut = 0;     ///< pairs of the other faces that were not looked at
};

/// As `boolean` does where it pays, but always, and in boxes as small as `limits` says.
/// \pre each operand bounds a solid
inline surface_of_some surface_of_active(std::span<const tf::mesh> operands,
                                         const tf::boolean_expression& expression,
                                         tf::fill_rule rule,
                                         const tf::detail::boolean::division_limits& limits,
                                         exact_numbers& numbers) {
    namespace detail = tf::detail::boolean;
    const std::vector<tf::mesh_view> views(operands.begin(), operands.end());
    const detail::joined_operands joined = detail::join_operands(views);
    const std::vector<std::uint32_t> operand_of_face = joined.operand_of_face();
    const detail::operand_edges edges = detail::find_operand_edges(joined.all, operand_of_face);
    const detail::surface_components components(joined.all, operand_of_face, edges);
    const detail::partial_expression at_nowhere(expression, rule);
    const detail::active_space space(components, at_nowhere, limits);
    surface_of_some result;
    std::vector<tf::face> faces;
    std::vector<std::uint32_t> operand;
    for (std::size_t f = 0; f < joined.all.faces.size(); ++f) {
        if (space.is_active_face()[f] == 0) continue;
        faces.push_back(joined.all.faces[f]);
        operand.push_back(operand_of_face[f]);
    }
    result.left_out = joined.all.faces.size() - faces.size();
    const tf::mesh_view active{joined.all.points, faces};
    const auto corners = [&](std::uint32_t f) {
        const auto& [a, b, c] = faces[f];
        return tf::triangle3{active.points[a], active.points[b], active.points[c]};
    };
    std::atomic<std::size_t> uncut = 0;
    tf::arrange_faces_result arranged =
        tf::detail::arrange::arrange_where(active,
                                           [&](const tf::aabb<double, 3>& box) {
                                               const bool wanted = space.reaches_active(box);
                                               uncut += wanted ? 0 : 1;
                                               return wanted;
                                           },
                                           {});
    result.uncut = uncut;
    arranged.cut.given_points = joined.all.points;
    const auto cells =
        find_active_cells(active, arranged.cut, operand, components, space, at_nowhere);
    const auto chosen = tf::detail::round::faces_around(arranged.cut, cells.cells, cells.inside);
    for (std::size_t f = 0; f < chosen.faces.size(); ++f) {
        const auto& [a, b, c] = chosen.faces[f];
        add(result.chain, numbers,
            {arranged.cut.point(a), arranged.cut.point(b), arranged.cut.point(c)},
            corners(arranged.cut.covers_of(chosen.face_of[f]).front().face));
    }
    return result;
}

}  // namespace test
