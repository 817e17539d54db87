#pragma once
/// \file
/// The area of a surface.

#include <treeform/mesh/mesh.hpp>

namespace treeform::detail::topology {

/// The sum of the areas of all faces, in square units; rounded as sums of doubles are.
///
/// \pre  every corner is a vertex
/// \cost O(F)
[[nodiscard]] double area(mesh_view mesh);

}  // namespace treeform::detail::topology
