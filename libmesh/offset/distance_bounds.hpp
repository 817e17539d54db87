#pragma once
/// \file
/// How near to a mesh, and how far from it, another one is: all of its points.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/parallel.hpp>

namespace treeform::detail::offset {

struct distance_bounds {
    double least = 0.0;
    double greatest = 0.0;
};

/// Bounds of the distances from all points of the faces of `from` to `mesh`. `least` is met;
/// `greatest` is no less than the greatest, and more by `slack` at most, unless faces would have to
/// be cut into more than 4^10 parts for that. To rounding. Both 0 where `progress` says stop.
///
/// \pre  both have faces
/// \same on any number of threads
[[nodiscard]] distance_bounds bounds_of_distance(mesh_view from, const prepared_mesh& mesh,
                                                 double slack, const progress_callback& progress);

}  // namespace treeform::detail::offset
