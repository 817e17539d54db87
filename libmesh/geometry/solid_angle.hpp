#pragma once
/// \file
/// Solid angles, computed only with the four basic operations and square roots in a fixed order, so
/// that results are bitwise equal on every platform with IEEE doubles.

#include <treeform/mesh/mesh.hpp>

namespace treeform::detail::geometry {

inline constexpr double full_solid_angle = 12.566370614359172;  ///< 4 pi

/// The angle of the vector (x, y) to the x axis, in [-pi, pi]; 0 for the zero vector. Like `atan2`,
/// with an error of up to 2e-11, and ignoring the signs of zeros.
[[nodiscard]] double angle_of(double y, double x);

/// The solid angle of a triangle as seen from the origin, in [-2 pi, 2 pi], with an error of up to
/// 1e-10 if the origin is not close to its plane. Positive if its corners appear clockwise, that
/// is, from behind.
///
/// \pre    coordinates are below 1e90
/// \source van Oosterom and Strackee, The Solid Angle of a Plane Triangle, IEEE Transactions on
///         Biomedical Engineering 30 (1983)
[[nodiscard]] double solid_angle(const point3& a, const point3& b, const point3& c);

}  // namespace treeform::detail::geometry
