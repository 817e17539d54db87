#pragma once
/// \file
/// Points that are defined by others, not by rounded coordinates, and the signs of polynomials in
/// them.
///
/// Where lines and planes through given points meet, the meeting point has rational coordinates.
/// It is kept as what defines it, together with an approximation and a proven bound on its error:
/// that ball answers most questions, and what it leaves open is decided from the defining points in
/// exact arithmetic. No tolerance; every function below returns the sign of the real number its
/// first line names, for all finite coordinates.
///
/// \cost   where the balls decide, below 10 ns. Exactly: `side` 0.2 to 0.4 us, `compare` 0.2 to
///         0.7 us, `orient2d` of three points 0.4 to 1.7 us, the more where three planes meet; on
///         coordinates whose exponents are more than 70 apart, ten times that
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

/// A given point, or one where lines and planes through given points meet.
class TREEFORM_API implicit_point {
  public:
    enum class origin : std::uint8_t {
        given,       ///< a point of the input, as it is
        lines,       ///< two lines of one plane
        line_plane,  ///< a line and a plane
        planes,      ///< three planes
        line_normal  ///< a line and a plane given by a point and a normal
    };

    /// The point itself. Implicit: wherever a constructed point can be, a given one can.
    /// \pre coordinates are finite; likewise of all points below
    implicit_point(const point3& p = {}) : center_(p) {}  // NOLINT

    /// The point that the lines through a, b and through c, d have in common.
    /// \pre    there is exactly one; likewise below
    /// \throws std::invalid_argument where the directions leave none or many; likewise below
    /// \cost   40 ns, of planes 60 ns; below a microsecond where they are nearly parallel, and a
    ///         few where differences are out of 1e-24 to 1e19
    [[nodiscard]] static implicit_point where_lines_cross(const point3& a, const point3& b,
                                                          const point3& c, const point3& d);

    /// The point that the line through a, b has in common with the plane.
    [[nodiscard]] static implicit_point where_line_meets(const point3& a, const point3& b,
                                                         const plane_points& plane);

    /// The point that the line through a, b has in common with the plane through `at` across
    /// `normal`.
    [[nodiscard]] static implicit_point where_line_meets(const point3& a, const point3& b,
                                                         const point3& at, const point3& normal);

    /// The point that three planes have in common.
    [[nodiscard]] static implicit_point where_planes_meet(const plane_points& p,
                                                          const plane_points& q,
                                                          const plane_points& r);

    [[nodiscard]] origin kind() const { return kind_; }
    /// An approximation: no coordinate is farther than `radius` from the exact one. The center is
    /// finite, the radius too but where a coordinate is beyond the range of double. With radius 0
    /// the point is its center, however defined.
    [[nodiscard]] const point3& center() const { return center_; }
    [[nodiscard]] double radius() const { return radius_; }
    /// What defines it, in the order given: none, 4, 5 or 9 points.
    /// Of `line_normal`: a, b, at, normal.
    [[nodiscard]] const std::array<point3, 9>& definition() const { return definition_; }

  private:
    /// Looks for a better ball where the radius is infinite.
    implicit_point(origin kind, const std::array<point3, 9>& definition,
                   const detail::exact::ball& about);

    point3 center_{};
    double radius_ = 0.0;
    origin kind_ = origin::given;
    std::array<point3, 9> definition_{};
};

/// Sign of a - b, coordinate `axis` (0, 1 or 2).
[[nodiscard]] TREEFORM_API int compare(int axis, const implicit_point& a, const implicit_point& b,
                                       predicate_counters* counters = nullptr);

/// Whether a and b are one point.
[[nodiscard]] TREEFORM_API bool equal(const implicit_point& a, const implicit_point& b,
                                      predicate_counters* counters = nullptr);

/// Sign of component `axis` of (b - a) x (c - a), as `orient2d` of given points.
[[nodiscard]] TREEFORM_API int orient2d(int axis, const implicit_point& a, const implicit_point& b,
                                        const implicit_point& c,
                                        predicate_counters* counters = nullptr);

/// Which side of the plane d is on: the sign of `orient3d(p.a, p.b, p.c, d)`.
[[nodiscard]] TREEFORM_API int side(const plane_points& p, const implicit_point& d,
                                    predicate_counters* counters = nullptr);

/// The point's coordinates, each rounded to the nearest double, ties to even; -0 is +0.
/// Infinite where the exact coordinate rounds to no finite double.
/// \cost 0.3 to 0.6 us, but nothing with radius 0
[[nodiscard]] TREEFORM_API point3 rounded(const implicit_point& p);

/// The same to the nearest floats, as doubles: rounded once.
/// \cost 10 ns; exact arithmetic only where the ball holds more than one rounding
[[nodiscard]] TREEFORM_API point3 rounded_to_float(const implicit_point& p);

/// Sign of component `axis` of n x m for the normals n, m of two planes.
[[nodiscard]] TREEFORM_API int normal_cross(int axis, const plane_points& p, const plane_points& q,
                                            predicate_counters* counters = nullptr);

}  // namespace treeform
