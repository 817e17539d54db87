#pragma once
/// \file
/// How rounding of coordinates changes a mesh.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/transform.hpp>

#include <cstdint>
#include <vector>

namespace treeform {

/// Distance between neighboring numbers of precision `of` at the largest finite coordinate of
/// `points`. When there is none, or all are 0, the least positive number.
[[nodiscard]] TREEFORM_API double coordinate_step(points_view points, precision of);

/// The points with each coordinate rounded to the nearest number of precision `to`; infinite beyond
/// its range.
[[nodiscard]] TREEFORM_API std::vector<point3> rounded(points_view points, precision to);

/// What rounding has broken.
struct rounding_defects {
    std::uint64_t collapsed = 0;  ///< faces that have lost their area
    /// Pairs of faces that meet now, and did not before: all kinds except touching and degenerate.
    std::uint64_t meeting = 0;
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest means nothing
};

/// What breaks when the points of `mesh` become `placed`, exactly. The mesh may have been moved and
/// turned, too: distances are not compared, only how faces lie to each other.
///
/// \throws std::invalid_argument as `self_intersections` for either, or for another number of
///         points
/// \cost   `self_intersections` of the mesh at the new points, and at the old ones only if any meet
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API rounding_defects
find_rounding_defects(mesh_view mesh, points_view placed, const progress_callback& progress = {});

/// Which rounding to look at.
struct rounding_options {
    precision before = precision::float64;  ///< of the points before the move
    precision after = precision::float64;   ///< of what is written
    progress_callback progress{};
};

/// How far rounding moved points, and what it has broken.
struct rounding_effects {
    double max_displacement = 0.0;  ///< largest change of a coordinate, apart from the move
    double step = 0.0;  ///< between neighboring numbers, at the largest coordinate written
    /// Doubles have become float32, or a change is more than a millionth of the size.
    bool noticeable = false;
    bool compared = false;        ///< faces were compared, because coordinates are coarser now
    std::uint64_t collapsed = 0;  ///< faces that have lost their area
    std::uint64_t meeting = 0;    ///< pairs of faces that meet now, and did not before
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest means nothing

    /// Adds the effects on another mesh.
    TREEFORM_API rounding_effects& operator+=(const rounding_effects& other);
};

/// Compares `placed` with the points of `moving` moved by `by`. Where coordinates are coarser than
/// before, it also compares the faces (`find_rounding_defects`).
///
/// \throws std::invalid_argument for another number of points
/// \cost   O(V); where coordinates are coarser, two `self_intersections` at most
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API rounding_effects
effects_of_rounding(const mesh_ref& moving, const transform<3>& by, points_view placed,
                    const rounding_options& options = {});

}  // namespace treeform
