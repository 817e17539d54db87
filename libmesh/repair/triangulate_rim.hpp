#pragma once
/// \file
/// Closes rims by triangles between their points.

#include <libmesh/repair/fill_hole.hpp>
#include <libmesh/repair/open_rims.hpp>
#include <libmesh/repair/working_mesh.hpp>

#include <vector>

namespace treeform::detail::repair {

/// Triangles between the points of the rim that close it and continue the faces around it: they
/// minimize a sum of areas, squares of longest edges, and folds at edges. None is degenerate, and
/// no edge repeats an edge of the mesh. For rims of more than 100 points, the best corners are
/// first cut off until 100 are left. Empty if there are no such triangles.
///
/// \param edges the edges of the mesh
/// \cost  O(n^3) for a rim of n <= 100 points; beyond that, plus O(n log n)
[[nodiscard]] std::vector<face> triangulate_rim(const working_mesh& mesh, const open_rim& rim,
                                                const directed_edges& edges);

}  // namespace treeform::detail::repair
