#pragma once
/// \file
/// The surface of all points at a distance, from cells.

#include <libmesh/offset/cell_grid.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/parallel.hpp>

namespace treeform::detail::offset {

/// The surface between corners of cells that are nearer to the mesh than `distance` and those that
/// are not. Each cell is six tetrahedra about its diagonal, each cut by a triangle or by two:
/// closed and manifold, whatever the distances are. Behind its faces is what is near, or else what
/// is far.
///
/// Empty where `progress` says stop.
///
/// \same on any number of threads
[[nodiscard]] mesh level_surface(const prepared_mesh& mesh, const cell_grid& grid, double distance,
                                 bool near_is_behind, const progress_callback& progress);

}  // namespace treeform::detail::offset
