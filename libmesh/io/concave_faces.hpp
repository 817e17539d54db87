#pragma once
/// \file
/// Counts concave polygons, whose fans of triangles overlap.

#include <treeform/mesh/mesh_file.hpp>

#include <cstddef>

namespace treeform::detail::io {

/// Number of stored faces with a triangle oriented against the whole face, as in a concave polygon.
/// Deviations below rounding errors do not count.
///
/// \cost O(F); O(1) if all faces are triangles
[[nodiscard]] std::size_t count_concave_faces(const mesh_file& file);

}  // namespace treeform::detail::io
