#pragma once
/// \file
/// Barycentric coordinates of points in faces, and normals of faces.

#include <treeform/mesh/mesh.hpp>

#include <array>

namespace treeform::detail::carry {

struct shares_of_corners {
    std::array<double, 3> of{1.0, 0.0, 0.0};  ///< barycentric coordinates; their sum is 1
    double outside = 0.0;  ///< sum of the magnitudes of negative coordinates that were set to 0
};

/// The barycentric coordinates of `p` in a triangle: exactly 1 for a corner if `p` equals it, and 1
/// for the first corner if the triangle has no area.
[[nodiscard]] shares_of_corners shares_at(const point3& p, const point3& a, const point3& b,
                                          const point3& c);

/// The parameter of `p` along the segment from `a` to `b`, in [0, 1]; 0 if `a` equals `b`.
[[nodiscard]] double share_along(const point3& p, const point3& a, const point3& b);

/// The normal of the face, with a length of twice its area.
[[nodiscard]] point3 normal_of(const mesh& mesh, const face& f);

/// Whether two normals point in opposite directions (negative dot product).
[[nodiscard]] bool is_turned(const point3& normal, const point3& other);

/// `v` as a unit vector; zero if `v` is zero.
[[nodiscard]] point3 with_length_one(const point3& v);

}  // namespace treeform::detail::carry
