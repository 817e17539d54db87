#pragma once
/// \file
/// Removes small solids and voids from results.

#include <treeform/mesh/boolean.hpp>

namespace treeform::detail::boolean {

/// Drops the components of `result.mesh` with a volume of magnitude below `least` cubic units, and
/// the points that no other face uses; counts them. The contents of a component are smaller than
/// it, and dropped as well, so faces still point outward.
///
/// \pre    the mesh is that of a certified solid, with vertices of its own for each part
/// \cost   O(V + F)
/// \same   on any number of threads
void drop_small_parts(boolean_result& result, double least);

}  // namespace treeform::detail::boolean
