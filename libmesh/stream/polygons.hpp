#pragma once
/// \file
/// Polygons that were cut into triangles become polygons again.

#include <treeform/mesh/mesh_file.hpp>

#include <cstdint>
#include <span>

namespace treeform::detail::stream {

/// Puts neighboring triangles of one polygon together that still are a fan, and leaves those that
/// are not, or that would repeat a corner which `unlike_corners` forbids, as faces of their own.
/// The row of a polygon is that of its first triangle. The reverse of `mesh_file::split_polygons`
/// when nothing has changed in between.
///
/// \pre `polygon` is [F], ascending; "face" has a row a triangle
void rejoin_polygons(mesh_file& file, std::span<const std::uint32_t> polygon, bool unlike_corners);

}  // namespace treeform::detail::stream
