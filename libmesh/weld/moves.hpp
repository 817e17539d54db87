#pragma once
/// \file
/// What merging points did to their places and to the normals of faces.

#include <libmesh/exact/plane_predicates.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>

namespace treeform::detail::weld {

/// The least double that is no less than the distance of any point from the place of its group;
/// infinity beyond the doubles. Points that are at their place bit for bit need not be finite.
[[nodiscard]] double max_displacement(points_view points,
                                      std::span<const std::uint32_t> group_of_point,
                                      points_view places);

/// Whether the normal of a triangle points away from the one it had, decided exactly. Not where it
/// has or had no area, or a corner that is not finite.
[[nodiscard]] bool is_flipped(const plane_points& before, const plane_points& after);

/// Faces of `after` whose normal points away from the one they had; face i was
/// `before.faces[face_of_new[i]]`.
[[nodiscard]] std::uint64_t count_flipped(mesh_view before, mesh_view after,
                                          std::span<const std::uint32_t> face_of_new);

}  // namespace treeform::detail::weld
