#pragma once
/// \file
/// Set operations on two solids whose surfaces need no second look.

#include <libmesh/boolean/pair_surface.hpp>
#include <treeform/mesh/boolean.hpp>

#include <optional>

namespace treeform::detail::boolean {

/// What `boolean` gives for two operands that are sound (`is_sound`), except for the count of
/// cells, which nobody needs: only faces near the other operand are arranged, the rest is copied.
///
/// `once` is as in `find_near_faces`. None where only the general way will do: float32 is asked for,
/// rounding has broken something, or the operands turn out not to be sound.
[[nodiscard]] std::optional<pair_result> boolean_of_sound_pair(const prepared_pair& operands,
                                                               bool once,
                                                               const boolean_expression& expression,
                                                               const boolean_options& options);

}  // namespace treeform::detail::boolean
