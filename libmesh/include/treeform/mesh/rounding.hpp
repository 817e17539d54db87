#pragma once
/// \file
/// What rounding coordinates does to a mesh.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/transform.hpp>

#include <cstdint>
#include <vector>

namespace treeform {

/// Distance between neighboring numbers of that precision at the largest coordinate of `points`.
/// The least there is, where all coordinates are 0 or there are none; those that are not finite
/// count for nothing.
[[nodiscard]] TREEFORM_API double coordinate_step(points_view points, precision of);

/// The points with each coordinate rounded to that precision: the nearest number, infinite beyond
/// its range.
[[nodiscard]] TREEFORM_API std::vector<point3> rounded(points_view points, precision to);

/// Largest change of a coordinate by which `placed` differs from `points` moved by `by`, which is
/// computed in twice the precision of double. Infinite where a number is not finite.
///
/// \pre as many points
[[nodiscard]] TREEFORM_API double max_displacement(points_view points, const transform<3>& by,
                                                   points_view placed);

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

struct rounding_options {
    precision before = precision::float64;  ///< of the points that were moved
    precision after = precision::float64;   ///< of what is written
    progress_callback progress{};
};

struct rounding_effects {
    double max_displacement = 0.0;  ///< largest change of a coordinate beside that of the move
    double step = 0.0;  ///< between neighboring numbers, at the largest coordinate written
    /// Where doubles have become float32, or a change is more than a millionth of the size.
    bool noticeable = false;
    bool compared = false;        ///< the faces were looked at, since steps are coarser than before
    std::uint64_t collapsed = 0;  ///< faces that have no area any more
    std::uint64_t meeting = 0;    ///< pairs of faces that meet, and did not
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest means nothing

    /// Of both together.
    TREEFORM_API rounding_effects& operator+=(const rounding_effects& other);
};

/// Compares `placed` with the points of `moving` moved by `by`, and its faces there with those
/// before where coordinates are coarser.
///
/// \throws std::invalid_argument for another number of points
/// \cost   O(V); where coordinates are coarser, two `self_intersections` at most
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API rounding_effects
effects_of_rounding(const prepared_mesh& moving, const transform<3>& by, points_view placed,
                    const rounding_options& options = {});
[[nodiscard]] TREEFORM_API rounding_effects
effects_of_rounding(mesh_view moving, const transform<3>& by, points_view placed,
                    const rounding_options& options = {});

}  // namespace treeform
