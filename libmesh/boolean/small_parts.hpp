#pragma once
/// \file
/// Results without specks and small voids.

#include <treeform/mesh/boolean.hpp>

namespace treeform::detail::boolean {

/// Drops the components of `result.mesh` with a volume, without its sign, below `least` cubic
/// units, and the points that no other face uses; counts them. What a component holds is smaller
/// than it, so that it goes along, and faces still look away from the inside.
///
/// \pre    the mesh is that of a certified solid, with vertices of its own for each part
/// \cost   O(V + F)
/// \same   on any number of threads
void drop_small_parts(boolean_result& result, double least);

}  // namespace treeform::detail::boolean
