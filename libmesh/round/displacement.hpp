#pragma once
/// \file
/// How far a surface lies from what it was made of.

#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>

namespace treeform::detail::round {

/// How far apart two surfaces are, in each coordinate, as seen from their vertices.
struct surface_moves {
    /// Points of the later one from the point of the earlier that each was, or else from the
    /// nearest place on its faces.
    double moved = 0.0;
    /// Points of the earlier one that are gone from the nearest place on the later: far, where a
    /// part that was too thin has gone.
    double gone = 0.0;
};

/// Measured in double where the points are, so that moves on the way there do not add up.
///
/// \param point_of  [V] of `now`: point of `before`, or beyond these
/// \pre   coordinates are finite
/// \cost  as `closest_point` for the points that are new or gone
/// \same  on any number of threads
[[nodiscard]] surface_moves displacement(mesh_view now, std::span<const std::uint32_t> point_of,
                                         mesh_view before);

}  // namespace treeform::detail::round
