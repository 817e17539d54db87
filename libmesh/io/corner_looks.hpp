#pragma once
/// \file
/// Converts normals and texture coordinates of corners to columns of points.

#include <treeform/mesh/mesh_file.hpp>

#include <vector>

namespace treeform::detail::io {

/// Columns nx, ny, nz (or s, t) of points if all corners at each point have the same value; empty
/// if some point has several. Points without a value have zeros.
[[nodiscard]] std::vector<column> normals_of_points(const mesh_file& file);
[[nodiscard]] std::vector<column> texture_of_points(const mesh_file& file);

}  // namespace treeform::detail::io
