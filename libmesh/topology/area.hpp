#pragma once
/// \file
/// The area of a surface.

#include <treeform/mesh/mesh.hpp>

namespace treeform::detail::topology {

/// The sum of the areas of all faces, in square units; a sum of doubles, with their rounding
/// errors.
///
/// \pre  every corner is a valid vertex number
/// \cost O(F)
[[nodiscard]] double area(mesh_view mesh);

}  // namespace treeform::detail::topology
