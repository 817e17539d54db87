#pragma once
/// \file
/// Constructed points, and where they are in GMP's rationals.

#include <libmesh/exact/implicit_point.hpp>

#include <gmpxx.h>

#include <array>
#include <cstddef>
#include <optional>

namespace treeform::test {

using rational_vector = std::array<mpq_class, 3>;

inline rational_vector rational(const point3& p) {
    return {mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)};
}
inline rational_vector minus(const rational_vector& a, const rational_vector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline rational_vector minus(const point3& a, const point3& b) {
    return minus(rational(a), rational(b));
}
inline mpq_class inner(const rational_vector& a, const rational_vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline rational_vector outer(const rational_vector& a, const rational_vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline rational_vector normal(const plane_points& p) {
    return outer(minus(p.b, p.a), minus(p.c, p.a));
}

/// A point and where it is.
struct known_point {
    implicit_point point;
    rational_vector at;
};

inline known_point given(const point3& p) { return {p, rational(p)}; }

/// a + t (b - a).
inline rational_vector along(const point3& a, const point3& b, const mpq_class& t) {
    rational_vector result = minus(b, a);
    const rational_vector from = rational(a);
    for (std::size_t i = 0; i < 3; ++i) result[i] = from[i] + t * result[i];
    return result;
}

inline std::optional<known_point> lines(const point3& a, const point3& b, const point3& c,
                                        const point3& d) {
    const rational_vector across = outer(minus(b, a), minus(d, c));
    const rational_vector from = outer(minus(c, a), minus(d, c));
    if (inner(minus(c, a), across) != 0) return {};
    for (std::size_t i = 0; i < 3; ++i)
        if (across[i] != 0)
            return known_point{implicit_point::where_lines_cross(a, b, c, d),
                               along(a, b, from[i] / across[i])};
    return {};
}

inline std::optional<known_point> line_plane(const point3& a, const point3& b,
                                             const plane_points& p) {
    const rational_vector n = normal(p);
    const mpq_class under = inner(n, minus(b, a));
    if (under == 0) return {};
    return known_point{implicit_point::where_line_meets(a, b, p),
                       along(a, b, inner(n, minus(p.a, a)) / under)};
}

inline std::optional<known_point> line_normal(const point3& a, const point3& b, const point3& at,
                                              const point3& n) {
    const mpq_class under = inner(rational(n), minus(b, a));
    if (under == 0) return {};
    return known_point{implicit_point::where_line_meets(a, b, at, n),
                       along(a, b, inner(rational(n), minus(at, a)) / under)};
}

inline std::optional<known_point> planes(const plane_points& p, const plane_points& q,
                                         const plane_points& r) {
    const rational_vector n = normal(p), m = normal(q), k = normal(r);
    const rational_vector mk = outer(m, k), kn = outer(k, n), nm = outer(n, m);
    const mpq_class under = inner(n, mk);
    if (under == 0) return {};
    const mpq_class x = inner(n, rational(p.a)), y = inner(m, rational(q.a)),
                    z = inner(k, rational(r.a));
    rational_vector at;
    for (std::size_t i = 0; i < 3; ++i) at[i] = (x * mk[i] + y * kn[i] + z * nm[i]) / under;
    return known_point{implicit_point::where_planes_meet(p, q, r), at};
}

}  // namespace treeform::test
