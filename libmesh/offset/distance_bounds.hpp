#pragma once
/// \file
/// Bounds of the distances from all points of one mesh to another.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/parallel.hpp>

namespace treeform::detail::offset {

struct distance_bounds {
    double least = 0.0;
    double greatest = 0.0;
};

/// Bounds of the distances from all points on the faces of `from` to `mesh`, up to rounding.
/// `least` is the minimum. `greatest` is at least the maximum and exceeds it by at most `slack`,
/// unless that needs faces to be split into more than 4^10 parts. Both are 0 when cancelled.
///
/// \pre  both have faces
/// \same on any number of threads
[[nodiscard]] distance_bounds bounds_of_distance(mesh_view from, const prepared_mesh& mesh,
                                                 double slack, const progress_callback& progress);

}  // namespace treeform::detail::offset
