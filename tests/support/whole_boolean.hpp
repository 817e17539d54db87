#pragma once
/// \file
/// Set operations with nothing left out: all faces cut along each other, and all cells found.

#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/boolean/finish_surface.hpp>
#include <libmesh/boolean/joined_operands.hpp>
#include <libmesh/boolean/partial_expression.hpp>
#include <libmesh/boolean/split_nonmanifold.hpp>
#include <libmesh/round/solid_faces.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
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
    auto joined = detail::boolean::join_operands(views);
    tf::arrange_faces_result arranged = tf::arrange_faces(joined.all);
    const tf::arrangement_cells cells =
        tf::find_cells(joined.all, arranged.cut, joined.operand_of_face(), operands.size());
    const tf::boolean_expression expression(text, operands.size());
    const std::size_t count = cells.winding.empty() ? 1 : cells.winding.size() / operands.size();
    std::vector<std::uint8_t> inside(count, 0);
    const auto in = std::make_unique<bool[]>(operands.size());
    for (std::uint32_t c = 0; c < count; ++c) {
        for (std::size_t k = 0; k < operands.size(); ++k)
            in[k] = !cells.winding.empty() &&
                    detail::boolean::is_inside(options.inside, cells.winding_of(c)[k]);
        inside[c] = expression({in.get(), operands.size()}) ? 1 : 0;
    }
    tf::boolean_result result = detail::boolean::with_counts(arranged);
    auto chosen = detail::round::faces_around(arranged.cut, cells, inside);
    detail::boolean::finish_surface(result, arranged.cut, std::move(chosen), joined, true, options);
    auto manifold = detail::boolean::split_nonmanifold(std::move(result.mesh));
    result.mesh = std::move(manifold.surface);
    for (const std::uint32_t p : manifold.vertex_of_added)
        result.vertex_source.push_back(result.vertex_source[p]);
    return result;
}

}  // namespace test
