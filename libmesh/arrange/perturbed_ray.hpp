#pragma once
/// \file
/// A ray along an axis that grazes nothing.

#include <libmesh/exact/implicit_point.hpp>
#include <libmesh/exact/plane_predicates.hpp>
#include <treeform/mesh/predicates.hpp>

#include <optional>

namespace treeform::detail::arrange {

/// Where a ray passes through a triangle.
struct crossing {
    plane_points plane;   ///< of the triangle
    int faces = 0;        ///< +1 where its normal points along the ray, -1 against it
    cutting_plane cut{};  ///< the plane, its normal along the ray
};

/// The ray in positive direction of an axis from a point v, moved: along an edge toward point b by
/// s, then across it by s^2, both seen along the axis, for an s > 0 smaller than any number. It
/// passes through triangles strictly inside or not at all, and no two of them in one point unless
/// they overlap there. Of an axis k, the other two are k + 1 and k + 2 modulo 3.
class perturbed_ray {
  public:
    /// \pre a coordinate of another axis than `along` of `toward` differs from that of `from`
    perturbed_ray(const point3& from, const point3& toward, int along = 0);

    /// How it passes through the triangle, if it does, ahead of where it starts. Triangles that the
    /// edge runs in are not ahead.
    [[nodiscard]] std::optional<crossing> meet(const triangle3& t) const;

    /// The parameter of a crossing, 2^-40 of itself wrong at most: how far it is from v.
    [[nodiscard]] double distance(const crossing& c) const;

    /// Sign of the difference of the places of two crossings: -1 when the ray gets to `c` first, 0
    /// when the triangles overlap there.
    [[nodiscard]] int compare(const crossing& c, const crossing& d) const;

    /// The sign of the normal of a triangle along the ray when the line of the ray passes through
    /// it, else 0. Corners are all given or all constructed.
    template <class Point>
    [[nodiscard]] int passes(const Point& a, const Point& b, const Point& c) const {
        const int sign = about(a, b);
        return sign != 0 && about(b, c) == sign && about(c, a) == sign ? sign : 0;
    }

  private:
    /// Which side of the directed edge from p to r the line passes, seen along it: +1 is the left.
    /// About a line through v, what counts is where b is; along a line through both, moving across
    /// it counts, by (-d.z, d.y) for d = b - v and a ray along x. 0 for edges parallel to the ray
    /// alone.
    template <class Point>
    [[nodiscard]] int about(const Point& p, const Point& r) const {
        if (const int sign = orient2d(along_, p, r, from_as<Point>()); sign != 0) return sign;
        if (const int sign = orient2d(along_, p, r, toward_as<Point>()); sign != 0) return sign;
        return treeform::compare(axis_, r, p) * ahead_;
    }

    template <class Point>
    [[nodiscard]] const Point& from_as() const;
    template <class Point>
    [[nodiscard]] const Point& toward_as() const;

    point3 from_;
    point3 toward_;
    implicit_point implicit_from_;
    implicit_point implicit_toward_;
    int along_;
    int axis_;   ///< another one, in which v and b differ
    int ahead_;  ///< sign of b - v there
};

/// From q along an axis, moved aside toward anywhere.
[[nodiscard]] perturbed_ray ray_beside(const point3& q, int along);

template <>
inline const point3& perturbed_ray::from_as() const {
    return from_;
}
template <>
inline const point3& perturbed_ray::toward_as() const {
    return toward_;
}
template <>
inline const implicit_point& perturbed_ray::from_as() const {
    return implicit_from_;
}
template <>
inline const implicit_point& perturbed_ray::toward_as() const {
    return implicit_toward_;
}

}  // namespace treeform::detail::arrange
