#pragma once
/// \file
/// Barycentric coordinates of a point of a triangle.

#include <treeform/mesh/mesh.hpp>

#include <array>

namespace treeform::detail::place {

/// The barycentric coordinates of `p` in the triangle `t`, as in `surface_point`.
///
/// \pre coordinates are finite; `p` is on the triangle, up to rounding: otherwise the result is for
///      some other point of the triangle
[[nodiscard]] std::array<double, 3> barycentric_weights(const std::array<point3, 3>& t,
                                                        const point3& p);

}  // namespace treeform::detail::place
