#pragma once
/// \file
/// The effects of merging on positions and on face normals.

#include <libmesh/exact/plane_predicates.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>

namespace treeform::detail::weld {

/// The least double that is not below the distance of any point from the position of its group;
/// infinity on overflow. Points that bitwise equal that position need not be finite.
[[nodiscard]] double max_displacement(points_view points,
                                      std::span<const std::uint32_t> group_of_point,
                                      points_view places);

/// Whether the normals of a triangle before and after point in opposite directions (negative dot
/// product), decided exactly. False if either triangle has no area or a corner that is not finite.
[[nodiscard]] bool is_flipped(const plane_points& before, const plane_points& after);

/// Number of flipped faces of `after`; face i was `before.faces[face_of_new[i]]`.
[[nodiscard]] std::uint64_t count_flipped(mesh_view before, mesh_view after,
                                          std::span<const std::uint32_t> face_of_new);

}  // namespace treeform::detail::weld
