#pragma once
/// \file
/// Planes and cylinders fitted to faces by least squares.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/properties.hpp>

#include <cstdint>
#include <optional>
#include <span>

namespace treeform::detail::place {

/// \pre the mesh was checked, the faces are faces of it
[[nodiscard]] std::optional<mesh_feature> fit_plane(mesh_view mesh,
                                                    std::span<const std::uint32_t> faces);

/// The same; the fit begins at `start` where one is given.
[[nodiscard]] std::optional<mesh_feature> fit_axis(mesh_view mesh,
                                                   std::span<const std::uint32_t> faces,
                                                   const mesh_feature* start = nullptr);

/// Of the point from the plane, along its normal; or from the cylinder, outward.
[[nodiscard]] double distance_from(const mesh_feature& feature, const point3& p);

/// What faces make of the circle around their axis.
struct circle_arc {
    double angle = 0.0;     ///< in degrees: all but the largest part that no corner is in
    std::size_t lines = 0;  ///< along the axis on which corners are, a tenth of a degree apart
};
[[nodiscard]] circle_arc arc_of(mesh_view mesh, const mesh_feature& axis);

/// Twice the area, times the normal.
[[nodiscard]] point3 double_area(mesh_view mesh, std::uint32_t face);

}  // namespace treeform::detail::place
