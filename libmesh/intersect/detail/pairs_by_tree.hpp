#pragma once
/// \file
/// Self-intersections of a mesh whose tree is there.

#include <libmesh/intersect/self_intersections.hpp>
#include <libmesh/mesh.hpp>
#include <libtree/tree.hpp>

namespace tf::detail {

/// As `self_intersections`; `tree` is that of the faces, and is gone when all has been found.
/// \pre all that `self_intersections` checks
[[nodiscard]] self_intersection_result pairs_by_tree(mesh_view mesh, tree<3> tree,
                                                     const self_intersection_options& options);

}  // namespace tf::detail
