#pragma once
/// \file
/// Rejoins triangles of polygons.

#include <treeform/mesh/mesh_file.hpp>

#include <cstdint>
#include <span>

namespace treeform::detail::stream {

/// Joins consecutive triangles of one polygon that still form a fan. Triangles that do not, or that
/// would repeat a corner although `unlike_corners` is set, stay separate faces. The row of a
/// polygon is that of its first triangle. The inverse of `mesh_file::split_polygons` if nothing
/// changed in between.
///
/// \pre `polygon` is [F], ascending; "face" has a row a triangle
void rejoin_polygons(mesh_file& file, std::span<const std::uint32_t> polygon, bool unlike_corners);

}  // namespace treeform::detail::stream
