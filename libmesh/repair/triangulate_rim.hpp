#pragma once
/// \file
/// Rims closed by triangles between their points.

#include <libmesh/repair/fill_hole.hpp>
#include <libmesh/repair/open_rims.hpp>
#include <libmesh/repair/working_mesh.hpp>

#include <vector>

namespace treeform::detail::repair {

/// Triangles between the points of the rim that close it and go on as the faces around it do: of
/// the least sum of areas, squares of longest edges, and folds at edges. None of them is degenerate
/// and no edge has been there before; of rims of more than 100 points, the best corners are cut off
/// first until so few are left. None where there is no such way.
///
/// \param edges of the mesh
/// \cost  O(n^3) for a rim of n <= 100 points, else O(n log n) more
[[nodiscard]] std::vector<face> triangulate_rim(const working_mesh& mesh, const open_rim& rim,
                                                const directed_edges& edges);

}  // namespace treeform::detail::repair
