#pragma once
/// \file
/// A ray along an axis, perturbed symbolically so that it grazes nothing.

#include <libmesh/exact/implicit_point.hpp>
#include <libmesh/exact/plane_predicates.hpp>
#include <treeform/mesh/predicates.hpp>

#include <optional>

namespace treeform::detail::arrange {

/// The crossing of a ray with a triangle.
struct crossing {
    plane_points plane;   ///< plane of the triangle
    int faces = 0;        ///< +1 if its normal points along the ray, -1 if against it
    cutting_plane cut{};  ///< the plane, with its normal along the ray
};

/// The ray in positive direction of an axis from a point v, perturbed: moved along an edge toward
/// point b by s, then across it by s^2, both in projection along the axis, for an infinitesimal s >
/// 0. It passes through triangles strictly inside or not at all, and never through two at one point
/// unless they overlap there. The other two axes of axis k are k + 1 and k + 2 modulo 3.
class perturbed_ray {
  public:
    /// \pre `from` and `toward` differ in a coordinate other than `along`
    perturbed_ray(const point3& from, const point3& toward, int along = 0);

    /// The crossing with a triangle, if the ray passes through it after its start. Triangles that
    /// contain the edge do not count.
    [[nodiscard]] std::optional<crossing> meet(const triangle3& t) const;

    /// The distance of a crossing from v, with a relative error of at most 2^-40.
    [[nodiscard]] double distance(const crossing& c) const;

    /// Compares two crossings along the ray: -1 if `c` is first, 0 if the triangles overlap there.
    [[nodiscard]] int compare(const crossing& c, const crossing& d) const;

    /// If the line of the ray passes through a triangle, the sign of the triangle's normal along
    /// the ray; else 0. Corners are all given or all constructed.
    template <class Point>
    [[nodiscard]] int passes(const Point& a, const Point& b, const Point& c) const {
        const int sign = about(a, b);
        return sign != 0 && about(b, c) == sign && about(c, a) == sign ? sign : 0;
    }

  private:
    /// The side of the directed edge from p to r on which the line passes, seen along the line: +1
    /// is left. If the edge's line passes through v, the position of b decides; if through both,
    /// the shift across, (-d.z, d.y) for d = b - v and a ray along x. 0 only for edges parallel to
    /// the ray.
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
    int axis_;   ///< another axis, in which v and b differ
    int ahead_;  ///< sign of b - v along `axis_`
};

/// The ray from q along an axis, perturbed in an arbitrary direction.
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
