#pragma once
/// \file
/// Stage 1 of the predicates of constructed points, for inlining.
///
/// Extends filter.hpp, with the same u = 2^-52 and guards, to points in balls: the center is given,
/// and the point differs from it by at most the radius r in each coordinate. The magnitudes of the
/// resulting error terms are summed (the count), each multiplied by (1 + 16 u) for the at most
/// eight roundings of the sum itself: (1 + 16 u) (1 - u)^8 > 1 + 7 u.

#include <libmesh/exact/filter.hpp>
#include <libmesh/exact/implicit_point.hpp>

#include <algorithm>
#include <cmath>

namespace treeform::detail::exact {

/// The position of a point for a filter: a center and an error radius. With radius 0, the point is
/// the center.
struct ball {
    point3 center;
    double radius;
};

inline ball ball_of(const implicit_point& p) { return {p.center(), p.radius()}; }

/// Factor that makes a count an upper bound after up to eight roundings.
inline constexpr double count_factor = 1.0 + 16 * 0x1p-52;

/// Stage 1 of `compare`.
///
/// d^ = (a - b) (1 + e) for the centers, up to 2^-1020, and the coordinates differ from them by r +
/// s. If |d^| >= 2^-550 exceeds the count, it exceeds r + s plus all rounding errors.
[[nodiscard]] inline int compare_filter(int axis, const ball& a, const ball& b) {
    const auto i = static_cast<std::size_t>(axis);
    const double difference = a.center[i] - b.center[i];
    const double magnitude = std::abs(difference);
    if (magnitude > count_factor * (a.radius + b.radius) && magnitude >= least_permanent)
        return (difference > 0.0) - (difference < 0.0);
    return undecided;
}

/// Stage 1 of `orient2d` along an axis.
///
/// Let v = b - a, w = c - a be exact, v^, w^ the computed differences of the centers, and R, S the
/// sums of the radii. A component of v differs from that of v^ by at most u |v^| + R, one of w by u
/// |w^| + S. So the error of a product is at most (2 u + u^2) |v^ w^| + (1 + u) (R |w^| + S |v^|) +
/// R S, and the error of both products, including their own roundings and that of their difference,
/// at most (4 u + 3 u^2) P + (1 + u) (R |w^| + S |v^| + 2 R S), with P the permanent and |v^| the
/// sum of the magnitudes of the components. 6 u P^ exceeds the first term by more than P u, which
/// exceeds the loss by underflow when |v^|, |w^|, R, S <= 2^400: fewer than 2^5 operations that
/// lose 2^-1020 each, times 2^402.
[[nodiscard]] inline int orient2d_filter(int axis, const ball& a, const ball& b, const ball& c) {
    const vector2<double> o = projection(axis, a.center);
    const vector2<double> v = projection(axis, b.center) - o;
    const vector2<double> w = projection(axis, c.center) - o;
    const double r = a.radius + b.radius;
    const double s = a.radius + c.radius;
    const double v_size = std::abs(v.x) + std::abs(v.y);
    const double w_size = std::abs(w.x) + std::abs(w.y);
    const sum det = cross(vector2<term>{{v.x}, {v.y}}, vector2<term>{{w.x}, {w.y}});
    const double error =
        6 * 0x1p-52 * det.magnitude + count_factor * (r * w_size + s * v_size + 2.0 * r * s);
    if (std::abs(det.value) > error && det.magnitude >= least_permanent &&
        std::max(std::max(v_size, w_size), std::max(r, s)) <= largest_difference<2>)
        return (det.value > 0.0) - (det.value < 0.0);
    return undecided;
}

/// Stage 1 of `side`.
///
/// As for `orient3d` of the center, whose constant c exceeds its error by P u / 2; one more u is
/// for the sum of both bounds. If a point differs from the center by r in each coordinate, the
/// value differs by at most r times the permanents of the components of the normal.
[[nodiscard]] inline int side_filter(const plane_points& p, const ball& d) {
    const auto o = vector_of(p.a);
    const std::array differences{vector_of(p.b) - o, vector_of(p.c) - o, vector_of(d.center) - o};
    const auto terms = transform(differences, [](double x) { return term{x}; });
    const auto n = cross(terms[0], terms[1]);
    const sum det = dot(n, terms[2]);
    const double normal = n.x.magnitude + n.y.magnitude + n.z.magnitude;
    const double error = (error_factor<orient3d_polynomial> + 0x1p-52) * det.magnitude +
                         count_factor * (d.radius * normal);
    if (std::abs(det.value) > error && det.magnitude >= least_permanent &&
        std::max(largest_magnitude(differences), d.radius) <= largest_difference<3>)
        return (det.value > 0.0) - (det.value < 0.0);
    return undecided;
}

}  // namespace treeform::detail::exact
