#pragma once
/// \file
/// Set operations with nothing left out: all faces cut along each other, and all cells found.

#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/boolean/bundled_operands.hpp>
#include <libmesh/boolean/cut_operand.hpp>
#include <libmesh/boolean/interaction_zone.hpp>
#include <libmesh/boolean/joined_operands.hpp>
#include <libmesh/boolean/near_surface.hpp>
#include <libmesh/boolean/partial_expression.hpp>
#include <libmesh/boolean/split_nonmanifold.hpp>
#include <libmesh/round/solid_faces.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace test {

/// What `boolean` is to return. \pre the operands are closed, and the result is certified
inline tf::boolean_result whole_boolean(const std::vector<tf::mesh>& operands,
                                        const std::string& text,
                                        const tf::boolean_options& options = {}) {
    namespace detail = tf::detail;
    const std::vector<tf::mesh_view> views(operands.begin(), operands.end());
    const auto known = detail::boolean::cut_operand_of(detail::boolean::join_operands(views), true);
    const auto none = tf::prepared_mesh::borrow(tf::mesh_view{});
    const auto& nothing = detail::boolean::cut_operand_of(none);
    detail::boolean::bundles bundles;
    bundles[0] = {.known = &known, .mesh = &*known.own};
    bundles[0].operand_of_face = known.joined.operand_of_face();
    bundles[1] = {.known = &nothing, .mesh = &none};
    detail::boolean::interaction_zone near;
    near.local = known.joined.all;
    near.face_of.resize(near.local.faces.size());
    near.point_of.resize(near.local.points.size());
    std::iota(near.face_of.begin(), near.face_of.end(), 0U);
    std::iota(near.point_of.begin(), near.point_of.end(), 0U);
    tf::arrange_faces_result arranged = tf::arrange_faces(near.local);
    const tf::arrangement_cells cells =
        tf::find_cells(near.local, arranged.cut, bundles[0].operand_of_face, operands.size());
    const tf::boolean_expression expression(text, operands.size());
    const std::size_t count = cells.winding.empty() ? 1 : cells.winding.size() / operands.size();
    std::vector<std::uint8_t> inside(count, 0);
    const auto in = std::make_unique<bool[]>(operands.size());
    for (std::uint32_t c = 0; c < count; ++c) {
        for (std::size_t k = 0; k < operands.size(); ++k)
            in[k] = !cells.winding.empty() &&
                    detail::boolean::is_inside(options.fill_rule, cells.winding_of(c)[k]);
        inside[c] = expression({in.get(), operands.size()}) ? 1 : 0;
    }
    detail::boolean::chosen_surface chosen{
        detail::round::faces_around(arranged.cut, cells, inside),
        detail::boolean::dispositions_of(bundles, near, detail::boolean::disposition::dropped)};
    tf::boolean_result result = std::move(
        detail::boolean::surface_of(bundles, near, arranged, std::move(chosen), options).result);
    auto manifold = detail::boolean::split_nonmanifold(std::move(result.mesh));
    result.mesh = std::move(manifold.surface);
    for (const std::uint32_t p : manifold.vertex_of_added)
        result.vertex_source.push_back(result.vertex_source[p]);
    return result;
}

}  // namespace test
