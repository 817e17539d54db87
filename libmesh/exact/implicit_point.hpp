#pragma once
/// \file
/// Points defined by other points instead of rounded coordinates, and predicates on them.
///
/// An intersection point of lines and planes through given points has rational coordinates. It is
/// stored as the defining points, with an approximation and a proven error bound (a ball). The ball
/// decides most predicates; the rest is decided from the defining points in exact arithmetic. There
/// is no tolerance: every predicate returns the sign of the real number in its first line, for all
/// finite coordinates.
///
/// \cost   below 10 ns if the balls decide. Exact arithmetic: `side` 0.2 to 0.4 us, `compare` 0.2
///         to 0.7 us, `orient2d` of three points 0.4 to 1.7 us, the most for intersections of three
///         planes; ten times that for coordinates whose exponents differ by more than 70
/// \source the kinds of points: Attene, Indirect Predicates for Geometric Constructions, CAD 126
///         (2020); their balls: the error analyzes in libmesh/exact/implicit_point.cpp

#include <libmesh/exact/plane_predicates.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>

#include <array>
#include <cstdint>

namespace treeform {

namespace detail::exact {
struct ball;
}

/// A given point, or an intersection point of lines and planes through given points.
class TREEFORM_API implicit_point {
  public:
    enum class origin : std::uint8_t {
        given,       ///< an input point
        lines,       ///< intersection of two coplanar lines
        line_plane,  ///< intersection of a line and a plane
        planes,      ///< intersection of three planes
        line_normal  ///< intersection of a line and a plane, given by a point and a normal
    };

    /// A given point. Implicit, so that a point can be passed wherever a constructed one can.
    /// \pre coordinates are finite; also in all functions below
    implicit_point(const point3& p = {}) : center_(p) {}  // NOLINT

    /// The intersection of the lines through a, b and through c, d.
    /// \pre    there is exactly one common point; also in the functions below
    /// \throws std::invalid_argument if the directions allow none or several; also below
    /// \cost   40 ns, for planes 60 ns; below a microsecond if they are nearly parallel, and a few
    ///         microseconds if differences are outside of 1e-24 to 1e19
    [[nodiscard]] static implicit_point where_lines_cross(const point3& a, const point3& b,
                                                          const point3& c, const point3& d);

    /// The intersection of the line through a, b with the plane.
    [[nodiscard]] static implicit_point where_line_meets(const point3& a, const point3& b,
                                                         const plane_points& plane);

    /// The intersection of the line through a, b with the plane through `at` with normal `normal`.
    [[nodiscard]] static implicit_point where_line_meets(const point3& a, const point3& b,
                                                         const point3& at, const point3& normal);

    /// The intersection of three planes.
    [[nodiscard]] static implicit_point where_planes_meet(const plane_points& p,
                                                          const plane_points& q,
                                                          const plane_points& r);

    [[nodiscard]] origin kind() const { return kind_; }
    /// An approximation: each coordinate is within `radius` of the exact one. The center is always
    /// finite; the radius is finite unless a coordinate is beyond the range of double. With radius
    /// 0, the point is exactly the center, however defined.
    [[nodiscard]] const point3& center() const { return center_; }
    [[nodiscard]] double radius() const { return radius_; }
    /// The defining points, in the order given: none, 4, 5 or 9. For `line_normal`: a, b, at,
    /// normal.
    [[nodiscard]] const std::array<point3, 9>& definition() const { return definition_; }

  private:
    /// Computes a better ball if the radius is infinite.
    implicit_point(origin kind, const std::array<point3, 9>& definition,
                   const detail::exact::ball& about);

    point3 center_{};
    double radius_ = 0.0;
    origin kind_ = origin::given;
    std::array<point3, 9> definition_{};
};

/// Sign of a - b in coordinate `axis` (0, 1 or 2).
[[nodiscard]] TREEFORM_API int compare(int axis, const implicit_point& a, const implicit_point& b,
                                       predicate_counters* counters = nullptr);

/// Whether a and b are the same point.
[[nodiscard]] TREEFORM_API bool equal(const implicit_point& a, const implicit_point& b,
                                      predicate_counters* counters = nullptr);

/// Sign of component `axis` of (b - a) x (c - a), as `orient2d` of given points.
[[nodiscard]] TREEFORM_API int orient2d(int axis, const implicit_point& a, const implicit_point& b,
                                        const implicit_point& c,
                                        predicate_counters* counters = nullptr);

/// The side of the plane that d is on: the sign of `orient3d(p.a, p.b, p.c, d)`.
[[nodiscard]] TREEFORM_API int side(const plane_points& p, const implicit_point& d,
                                    predicate_counters* counters = nullptr);

/// The coordinates of the point, each rounded to the nearest double, ties to even; never -0.
/// Infinite if the exact coordinate overflows.
/// \cost 0.3 to 0.6 us; none with radius 0
[[nodiscard]] TREEFORM_API point3 rounded(const implicit_point& p);

/// The same, rounded once to the nearest floats, as doubles.
/// \cost 10 ns; exact arithmetic only if the ball does not determine the rounding
[[nodiscard]] TREEFORM_API point3 rounded_to_float(const implicit_point& p);

/// Sign of component `axis` of n x m for the normals n, m of two planes.
[[nodiscard]] TREEFORM_API int normal_cross(int axis, const plane_points& p, const plane_points& q,
                                            predicate_counters* counters = nullptr);

}  // namespace treeform
