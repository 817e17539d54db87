#pragma once
/// \file
/// Weights of corners.

#include <treeform/mesh/mesh.hpp>

#include <array>

namespace treeform::detail::place {

/// The weights of the corners of `t` that give the point `p` of it, as in `surface_point`.
///
/// \pre coordinates are finite; `p` is on the triangle, except for rounding: otherwise the weights
///      are those of some other point of it
[[nodiscard]] std::array<double, 3> barycentric_weights(const std::array<point3, 3>& t,
                                                        const point3& p);

}  // namespace treeform::detail::place
