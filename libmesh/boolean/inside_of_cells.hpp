#pragma once
/// \file
/// Which cells of an arrangement a set operation keeps, and how large they are.

#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <treeform/mesh/boolean.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

[[nodiscard]] bool is_inside(fill_rule rule, std::int32_t winding);

/// [C] 1 where the expression is true.
/// \same on any number of threads
[[nodiscard]] std::vector<std::uint8_t> inside_of_cells(const arrangement_cells& cells,
                                                        fill_rule rule,
                                                        const boolean_expression& expression);

/// \pre  there are two operands, and the surface of each is closed
/// \same on any number of threads
[[nodiscard]] operand_volumes find_volumes(std::span<const mesh_view> operands,
                                           const mesh_arrangement& cut,
                                           const arrangement_cells& cells, fill_rule rule);

}  // namespace treeform::detail::boolean
