#pragma once
/// \file
/// Fairs fillings of large holes, so that they continue the surface around them smoothly.

#include <libmesh/base/stars.hpp>
#include <libmesh/repair/open_rims.hpp>
#include <libmesh/repair/working_mesh.hpp>

#include <cstddef>
#include <vector>

namespace treeform::detail::repair {

/// Whether a filling should be smooth: it has enough triangles, and its angle to the faces around
/// it is at most 45 degrees along half of the rim, but not below 2 degrees along nearly all of that
/// half. If a body was cut off, or the surface around the hole is flat, even up to a sharp edge at
/// the hole, the filling stays flat.
[[nodiscard]] bool is_to_be_fair(const working_mesh& mesh, const open_rim& rim,
                                 const std::vector<face>& filling);

/// Moves the points from `first` on, which only `filling` uses, to minimize the sum of the squares
/// of the surface's Laplacian. Does not move them if that leads further from the rim than the rim
/// is wide.
///
/// \param stars [V] the faces of the mesh without the filling at each point
/// \cost  O(n) for n points, up to 2000 times
/// \same  on any number of threads
/// \source Liepa, Filling holes in meshes, SGP 2003, section 5; solved by conjugate gradients
void make_fair(working_mesh& mesh, const open_rim& rim, const std::vector<face>& filling,
               std::size_t first, const base::stars& stars);

}  // namespace treeform::detail::repair
