#pragma once
/// \file
/// How far a surface lies from what it was made of.

#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>

namespace treeform::detail::round {

/// How far points of `now` are from where they were, in each coordinate: from the point of `before`
/// that each was, or, where `point_of` is beyond these, from the nearest place on the faces of
/// `before`. Measured in double where the points are, so that moves on the way there do not add
/// up.
///
/// \param point_of  [V] of `now`
/// \pre   coordinates are finite
/// \cost  as `closest_point` for the points that are new
/// \same  on any number of threads
[[nodiscard]] double displacement(points_view now, std::span<const std::uint32_t> point_of,
                                  mesh_view before);

}  // namespace treeform::detail::round
