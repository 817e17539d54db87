#pragma once
/// \file
/// Where in a face a point is, and how faces look.

#include <treeform/mesh/mesh.hpp>

#include <array>

namespace treeform::detail::carry {

struct shares_of_corners {
    std::array<double, 3> of{1.0, 0.0, 0.0};  ///< sums up to 1
    double outside = 0.0;  ///< what was left out as it was negative, on the same scale
};

/// How much of each corner of a triangle there is in a point of it: exactly 1 of a corner where it
/// is that one, and of the first where the triangle has no area.
[[nodiscard]] shares_of_corners shares_at(const point3& p, const point3& a, const point3& b,
                                          const point3& c);

/// How far along from `a` to `b` a point is, from 0 to 1; 0 where they are equal.
[[nodiscard]] double share_along(const point3& p, const point3& a, const point3& b);

/// Twice the area long.
[[nodiscard]] point3 normal_of(const mesh& mesh, const face& f);

/// Whether two normals look away from each other.
[[nodiscard]] bool is_turned(const point3& normal, const point3& other);

/// `v` itself where it is zero.
[[nodiscard]] point3 with_length_one(const point3& v);

}  // namespace treeform::detail::carry
