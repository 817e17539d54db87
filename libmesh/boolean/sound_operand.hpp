#pragma once
/// \file
/// Whether an operand bounds a solid without a second look.

#include <treeform/mesh/prepared_mesh.hpp>

namespace treeform::detail::boolean {

/// Whether two faces of `mesh` have a common corner, a common edge or nothing in common, none is
/// degenerate, no two vertices have equal coordinates, every edge is closed, and what is behind the
/// faces is inside: as of what `boolean` has certified. The mesh keeps the answer.
///
/// \throws std::invalid_argument as `boolean`
/// \cost   once, that of `boolean` with this operand alone
/// \same   on any number of threads
[[nodiscard]] bool is_sound(const prepared_mesh& mesh);

}  // namespace treeform::detail::boolean
