#pragma once
/// \file
/// Meshes for the boxes, cylinders and spheres of robots.

#include <treeform/mesh/mesh.hpp>

#include <array>

namespace treeform::detail::io {

/// Twelve faces; exact where halves of the sizes are.
[[nodiscard]] mesh box_shape(const std::array<double, 3>& size);

/// A prism of 96 sides around the cylinder about z, from -length / 2 to length / 2. No point of the
/// cylinder's side is outside it; its corners are up to 0.054 % of the radius further out.
[[nodiscard]] mesh cylinder_shape(double radius, double length);

/// 5,120 faces around the sphere: none comes closer to its center than `radius`, none is further
/// out than 0.13 % of that.
[[nodiscard]] mesh sphere_shape(double radius);

}  // namespace treeform::detail::io
