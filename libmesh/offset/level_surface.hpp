#pragma once
/// \file
/// Extracts the surface at a given distance from cells (marching tetrahedra).

#include <libmesh/offset/cell_grid.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/parallel.hpp>

namespace treeform::detail::offset {

/// The surface between the corners of cells that are nearer to the mesh than `distance` and those
/// that are not. Each cell is divided into six tetrahedra about its diagonal, and each tetrahedron
/// is cut by one or two triangles: the surface is closed and manifold for any distances. With
/// `near_is_behind`, the near side is behind its faces; otherwise the far side.
///
/// Empty when cancelled.
///
/// \same on any number of threads
[[nodiscard]] mesh level_surface(const prepared_mesh& mesh, const cell_grid& grid, double distance,
                                 bool near_is_behind, const progress_callback& progress);

}  // namespace treeform::detail::offset
