#pragma once
/// \file
/// What rounding the coordinates of a mesh has done to it.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/transform.hpp>

#include <cstdint>
#include <vector>

namespace treeform {

/// Distance between neighboring numbers at the largest coordinate of `points`: of float32, if
/// `single`, else of double. The least there is, where all coordinates are 0 or there are none;
/// those that are not finite count for nothing.
[[nodiscard]] TREEFORM_API double coordinate_step(points_view points, bool single);

/// Largest change of a coordinate by which `placed` differs from `points` moved by `by`, which is
/// computed in twice the precision of double. Infinite where a number is not finite.
///
/// \pre as many points
[[nodiscard]] TREEFORM_API double largest_move(points_view points, const transform<3>& by,
                                               points_view placed);

/// The points with each coordinate rounded to float32: the nearest one, infinite beyond its range.
[[nodiscard]] TREEFORM_API std::vector<point3> in_single(points_view points);

struct rounding_defects {
    std::uint64_t collapsed = 0;  ///< faces that have no area, and had one
    /// Pairs of faces that meet, and did not: all kinds but touching and degenerate ones.
    std::uint64_t meeting = 0;
    bool cancelled = false;  ///< `progress` said stop; the rest means nothing
};

/// Compares `mesh` with its faces at the points `placed`. It may have been moved and turned: no
/// distance is looked at, only what faces do to each other. Exact on both.
///
/// \throws std::invalid_argument as `self_intersections` for either, or for another number of
///         points
/// \cost   `self_intersections` of the mesh at the new points, and at the old ones only if any meet
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API rounding_defects
find_rounding_defects(mesh_view mesh, points_view placed, const progress_callback& progress = {});

}  // namespace treeform
