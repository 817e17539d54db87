#pragma once
/// \file
/// Triangles as seen along a direction, and how far apart two are where one covers the other.

#include <libmesh/base/point_math.hpp>
#include <treeform/mesh/triangle.hpp>

#include <array>
#include <optional>

namespace treeform::detail::simplify {

[[nodiscard]] inline point3 normal_of(const triangle3& t) {
    return base::cross(base::minus(t[1], t[0]), base::minus(t[2], t[0]));
}

/// Where in the view a point is, as x and y, and how near to the eye, as z.
using seen_triangle = std::array<point3, 3>;

/// A view along a direction, around a point.
///
/// Two points that are seen at one place are as far apart as their heights differ, to 8 u of that:
/// axes are at right angles and of length 1 to a few u, however little the direction itself is known.
class view_along {
  public:
    view_along(const point3& direction, const point3& around);

    [[nodiscard]] seen_triangle see(const triangle3& t) const;
    /// Whether `t` looks at the eye, by more than 11 degrees, and is not as good as a segment.
    [[nodiscard]] bool faces_eye(const triangle3& t, const seen_triangle& seen) const;

  private:
    point3 around_, across_, up_, along_;
};

/// The greatest magnitude of a coordinate in the view.
[[nodiscard]] double extent_of(const seen_triangle& t);

/// How far heights of `a` and `b` differ at most where both are seen; none where one of them is at
/// each place. Never too little, and never none where there is a common place.
///
/// With u = 2^-53 and S the larger extent: places are off by 4 u S, corners cut by 8 u S more, and
/// `sides` that decide by 32 u S^2: what is outside by no more than 2^-46 S^2 is kept. Planes rise by
/// less than 5 in 1 (`faces_eye`), so that heights at cut corners are off by less than 128 u S, and
/// differences by twice that and 8 u S: 2^-44 S is added.
///
/// \pre both face the eye
[[nodiscard]] std::optional<double> gap_between(const seen_triangle& a, const seen_triangle& b);

/// Whether `at` is seen within `t`, beyond doubt.
[[nodiscard]] bool is_seen_within(const seen_triangle& t, const point3& at);

}  // namespace treeform::detail::simplify
