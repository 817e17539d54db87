#pragma once
/// \file
/// Polygons whose fans of triangles lie on each other.

#include <treeform/mesh/mesh_file.hpp>

#include <cstddef>

namespace treeform::detail::io {

/// How many stored faces have a triangle that is turned against the face as a whole, as where a
/// polygon is not convex. Ones that are so by less than rounding does are none.
///
/// \cost O(F), nothing where all faces are triangles
[[nodiscard]] std::size_t count_concave_faces(const mesh_file& file);

}  // namespace treeform::detail::io
