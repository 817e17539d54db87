#pragma once
/// \file
/// Refines a filling to the size of the triangles around it.

#include <libmesh/repair/fill_hole.hpp>
#include <libmesh/repair/open_rims.hpp>
#include <libmesh/repair/working_mesh.hpp>

#include <vector>

namespace treeform::detail::repair {

/// `filling` with new points at the centers of triangles that are large compared with the edges of
/// the rim near them, and with edges flipped if the opposite angles add up to more than 180
/// degrees. No triangle is degenerate, and no edge repeats an edge of the mesh.
///
/// \param edges the edges of the mesh without the filling
/// \cost  O(n log n) for n points, at most 100,000
/// \same  on any number of threads
/// \source Liepa, Filling holes in meshes, SGP 2003, section 4
[[nodiscard]] std::vector<face> refined_patch(working_mesh& mesh, const open_rim& rim,
                                              const std::vector<face>& filling,
                                              const directed_edges& edges);

}  // namespace treeform::detail::repair
