#pragma once
/// \file
/// What coordinates that are written have lost by rounding.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/export.hpp>
#include <treeform/tree/progress.hpp>
#include <treeform/tree/transform.hpp>

#include <cstdint>

namespace treeform {

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
