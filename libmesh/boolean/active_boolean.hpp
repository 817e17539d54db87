#pragma once
/// \file
/// Set operations whose cost follows the result: what cannot be in it is not cut.

#include <libmesh/boolean/finish_surface.hpp>
#include <libmesh/boolean/joined_operands.hpp>
#include <libmesh/boolean/operand_edges.hpp>
#include <treeform/mesh/boolean.hpp>

#include <optional>

namespace treeform::detail::boolean {

/// What `boolean` makes of operands that are closed: only faces near the result's surface are
/// arranged, and only where they meet there.
///
/// None where that would leave out too little to be worth it, or only the general way will do;
/// `joined` is as before then. Otherwise it is used up.
///
/// \param edges of `joined`; used up
/// \same  on any number of threads
[[nodiscard]] std::optional<boolean_result> boolean_in_active_space(
    joined_operands& joined, operand_edges&& edges, const boolean_expression& expression,
    const boolean_options& options, left_faces is_left = nullptr);

}  // namespace treeform::detail::boolean
