#pragma once
/// \file
/// Triangles as seen along a direction, and how far apart two are where one covers the other.

#include <libmesh/base/point_math.hpp>
#include <treeform/mesh/predicates.hpp>

#include <array>
#include <cmath>
#include <optional>

namespace treeform::detail::simplify {

[[nodiscard]] inline point3 normal_of(const triangle3& t) {
    return base::cross(base::minus(t[1], t[0]), base::minus(t[2], t[0]));
}

/// Of length 1 to a few u, or 0 where `v` has no length.
[[nodiscard]] inline point3 unit_of(const point3& v) {
    const double square = base::dot(v, v);
    return base::scaled(v, square > 0.0 ? 1.0 / std::sqrt(square) : 0.0);
}

/// Where in the view corners are, as x and y, and how near to the eye, as z.
struct seen_triangle {
    std::array<point3, 3> at;
    double extent = 0.0;  ///< greatest magnitude of a coordinate
};

/// A view along a direction, around a point.
///
/// Two points that are seen at one place are as far apart as their heights differ, to 8 u of that:
/// axes are at right angles and of length 1 to a few u, however little the direction itself is
/// known.
class view_along {
  public:
    view_along(const point3& direction, const point3& around);

    [[nodiscard]] seen_triangle see(const triangle3& t) const;
    /// Whether `t` looks at the eye, by more than 11 degrees, and is not as good as a segment.
    [[nodiscard]] bool faces_eye(const triangle3& t, const seen_triangle& seen) const;

  private:
    point3 around_, across_, up_, along_;
};

/// How far heights of `a` and `b` differ at most where both are seen; none where one of them is at
/// each place. Never too little, and never none where there is a common place.
///
/// With u = 2^-53 and S the larger extent: places are off by 4 u S, corners cut by 8 u S more, and
/// twice the area that tells the side of a line by 64 u S^2. What is outside by no more than twice
/// that is kept, so that no corner is cut off that is common. Edges rise by less than 5 in 1
/// (`faces_eye`), so that heights at corners of `a` that are cut are off by less than 128 u S.
/// Those of the plane of `b` are off by as much, and as a share of its area by 64 u S^2 each of
/// two: 2^-44 S and 2^-45 S^2 / area times its rise are added.
///
/// \pre both face the eye; of `a`, two corners may be one
[[nodiscard]] std::optional<double> gap_between(const seen_triangle& a, const seen_triangle& b);

/// Whether `at` is seen within `t`, beyond doubt.
[[nodiscard]] bool is_seen_within(const seen_triangle& t, const point3& at);

}  // namespace treeform::detail::simplify
