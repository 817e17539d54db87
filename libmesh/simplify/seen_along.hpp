#pragma once
/// \file
/// Triangles projected along a direction, and the gap between two of them where they overlap in the
/// projection.

#include <libmesh/base/point_math.hpp>
#include <treeform/mesh/predicates.hpp>

#include <array>
#include <cmath>
#include <optional>

namespace treeform::detail::simplify {

[[nodiscard]] inline point3 normal_of(const triangle3& t) {
    return base::cross(base::minus(t[1], t[0]), base::minus(t[2], t[0]));
}

/// `v` as a unit vector, up to a few u; 0 if `v` is 0.
[[nodiscard]] inline point3 unit_of(const point3& v) {
    const double square = base::dot(v, v);
    return base::scaled(v, square > 0.0 ? 1.0 / std::sqrt(square) : 0.0);
}

/// A projected triangle: x and y are positions in the view, z is the height toward the viewer.
struct seen_triangle {
    std::array<point3, 3> at;
    double extent = 0.0;  ///< largest magnitude of a coordinate
};

/// An orthogonal projection along a direction, with a point as its origin.
///
/// The distance of two points with the same projection is the difference of their heights, up to 8
/// u of it: the axes are orthonormal up to a few u, even if the direction is imprecise.
class view_along {
  public:
    view_along(const point3& direction, const point3& around);

    [[nodiscard]] seen_triangle see(const triangle3& t) const;
    /// Whether `t` faces the viewer by more than 11 degrees and is not nearly degenerate.
    [[nodiscard]] bool faces_eye(const triangle3& t, const seen_triangle& seen) const;

  private:
    point3 around_, across_, up_, along_;
};

/// An upper bound of the height difference of `a` and `b` where their projections overlap. Empty
/// only if they do not overlap. Conservative.
///
/// With u = 2^-53 and S the larger extent: positions are off by 4 u S, clipped corners by 8 u S
/// more, and the doubled area that decides the side of a line by 64 u S^2. Points outside by no
/// more than twice that are kept, so that no common corner is clipped. Edges rise by less than 5 in
/// 1 (`faces_eye`), so that the heights of clipped corners of `a` are off by less than 128 u S.
/// Heights of the plane of `b` are off by as much, and relative to its area by twice 64 u S^2:
/// 2^-44 S and 2^-45 S^2 / area times its rise are added.
///
/// \pre both face the viewer; two corners of `a` may be equal
[[nodiscard]] std::optional<double> gap_between(const seen_triangle& a, const seen_triangle& b);

/// Whether the projection of `at` is certainly inside that of `t`.
[[nodiscard]] bool is_seen_within(const seen_triangle& t, const point3& at);

}  // namespace treeform::detail::simplify
