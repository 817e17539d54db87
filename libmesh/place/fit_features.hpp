#pragma once
/// \file
/// Planes and cylinders fitted to faces by least squares.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/properties.hpp>

#include <cstdint>
#include <optional>
#include <span>

namespace treeform::detail::place {

/// \pre the mesh was checked; `faces` are valid face numbers
[[nodiscard]] std::optional<mesh_feature> fit_plane(mesh_view mesh,
                                                    std::span<const std::uint32_t> faces);

/// Fits a cylinder; `start`, if given, is the initial guess.
[[nodiscard]] std::optional<mesh_feature> fit_axis(mesh_view mesh,
                                                   std::span<const std::uint32_t> faces,
                                                   const mesh_feature* start = nullptr);

/// The signed distance of the point from the plane, along its normal, or from the cylinder,
/// positive outside.
[[nodiscard]] double distance_from(const mesh_feature& feature, const point3& p);

/// How much of the circle around their axis faces cover.
struct circle_arc {
    double angle = 0.0;     ///< degrees: 360 minus the largest gap between corners
    std::size_t lines = 0;  ///< lines along the axis with corners, at least 0.1 degrees apart
};
[[nodiscard]] circle_arc arc_of(mesh_view mesh, const mesh_feature& axis);

/// The normal of the face, with a length of twice its area.
[[nodiscard]] point3 double_area(mesh_view mesh, std::uint32_t face);

}  // namespace treeform::detail::place
