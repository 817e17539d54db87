#pragma once
/// \file
/// The displacement of a surface from the one of which it was made.

#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>

namespace treeform::detail::round {

/// The distance of two surfaces, as the largest difference of a coordinate, measured at their
/// vertices.
struct surface_moves {
    /// Displacement of points of the later surface: from the earlier point that each was, or else
    /// from the nearest point of the earlier faces.
    double moved = 0.0;
    /// Distance of removed points of the earlier surface from the nearest point of the later one.
    /// Large if a part that was too thin was removed.
    double gone = 0.0;
};

/// Computed in double, from the final points, so that intermediate moves do not add up.
///
/// \param point_of  [V of `now`] point of `before`; or a number beyond these
/// \pre   coordinates are finite
/// \cost  as `closest_point` for the points that are new or gone
/// \same  on any number of threads
[[nodiscard]] surface_moves displacement(mesh_view now, std::span<const std::uint32_t> point_of,
                                         mesh_view before);

}  // namespace treeform::detail::round
