#pragma once
/// \file
/// Fillings of large holes that go on as the surface around them does.

#include <libmesh/base/stars.hpp>
#include <libmesh/repair/open_rims.hpp>
#include <libmesh/repair/working_mesh.hpp>

#include <cstddef>
#include <vector>

namespace treeform::detail::repair {

/// Whether triangles that close a rim are so many, and bend away from the faces around it so
/// little, that a smooth surface is meant: by 45 degrees at most along half of the rim, but not by
/// less than 2 degrees along nearly all of that half. Where a body was cut off, and where the
/// surface around a hole is flat, also if it ends at the hole in a sharp edge, the filling stays
/// flat.
[[nodiscard]] bool is_to_be_fair(const working_mesh& mesh, const open_rim& rim,
                                 const std::vector<face>& filling);

/// Moves the points from `first` on, which only faces of `filling` have, to where the surface bends
/// the least: the squares of its Laplacian have the least sum. Leaves them where they are if that
/// leads away from the rim further than it is wide.
///
/// \param stars [V] the faces of the mesh without the filling at each point
/// \cost  O(n) for n points, up to 2000 times
/// \same  on any number of threads
/// \source Liepa, Filling holes in meshes, SGP 2003, section 5; solved by conjugate gradients
void make_fair(working_mesh& mesh, const open_rim& rim, const std::vector<face>& filling,
               std::size_t first, const base::stars& stars);

}  // namespace treeform::detail::repair
