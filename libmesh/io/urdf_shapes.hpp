#pragma once
/// \file
/// Meshes for the boxes, cylinders and spheres of robots.

#include <treeform/mesh/mesh.hpp>

#include <array>

namespace treeform::detail::io {

/// Twelve faces; exact if half of each size is exact.
[[nodiscard]] mesh box_shape(const std::array<double, 3>& size);

/// A prism of 96 sides that contains the cylinder about z, from -length / 2 to length / 2. Its
/// corners are up to 0.054 % of the radius outside of the cylinder.
[[nodiscard]] mesh cylinder_shape(double radius, double length);

/// 5,120 faces that contain the sphere; no point is further outside than 0.13 % of the radius.
[[nodiscard]] mesh sphere_shape(double radius);

}  // namespace treeform::detail::io
