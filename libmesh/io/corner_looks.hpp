#pragma once
/// \file
/// Normals and texture coordinates of corners as values of points.

#include <treeform/mesh/mesh_file.hpp>

#include <vector>

namespace treeform::detail::io {

/// Columns nx, ny, nz of points whose corners all have one normal, and s, t likewise; none where
/// some point has several. Points without any have zeros.
[[nodiscard]] std::vector<column> normals_of_points(const mesh_file& file);
[[nodiscard]] std::vector<column> texture_of_points(const mesh_file& file);

}  // namespace treeform::detail::io
