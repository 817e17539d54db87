#pragma once
/// \file
/// Solid angles, by nothing but the four operations and square roots: of fixed order, so that they
/// are the same to the last bit wherever doubles are.

#include <treeform/mesh/mesh.hpp>

namespace treeform::detail::geometry {

inline constexpr double full_solid_angle = 12.566370614359172;  ///< 4 pi

/// The angle of the vector (x, y) against the direction x, in [-pi, pi]; 0 of the vector 0. As
/// `atan2`, except for an error of up to 2e-11, and without the signs of zeros.
[[nodiscard]] double angle_of(double y, double x);

/// The solid angle of a triangle as seen from the origin, in [-2 pi, 2 pi], up to an error of 1e-10
/// where the origin is not next to its plane: positive where its corners are seen clockwise, as
/// from behind it.
///
/// \pre    coordinates are below 1e90
/// \source van Oosterom and Strackee, The Solid Angle of a Plane Triangle, IEEE Transactions on
///         Biomedical Engineering 30 (1983)
[[nodiscard]] double solid_angle(const point3& a, const point3& b, const point3& c);

}  // namespace treeform::detail::geometry
