#pragma once
/// \file
/// The set operation behind `clip`.

#include <libmesh/boolean/joined_operands.hpp>
#include <libmesh/boolean/operand_edges.hpp>
#include <treeform/mesh/boolean.hpp>

#include <cstdint>

namespace treeform::detail::boolean {

/// What `expression` keeps of an operand that need not be closed. Faces of the others are looked at
/// only where they reach into the boxes of its faces, and cut along these only; so where solids meet
/// each other costs nothing. What is beside each patch of the sheet, a line tells.
///
/// \pre  the other operands are closed
/// \same on any number of threads
[[nodiscard]] boolean_result clip_sheet(joined_operands& joined, const operand_edges& edges,
                                        std::uint32_t sheet, const boolean_expression& expression,
                                        const boolean_options& options);

}  // namespace treeform::detail::boolean
