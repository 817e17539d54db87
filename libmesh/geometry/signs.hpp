#pragma once
/// \file
/// The predicates as used by the triangle tests: with an inlined filter, so that calls with common
/// arguments share work, and a test for equal points before exact computation.

#include <libmesh/exact/filter.hpp>
#include <libmesh/exact/stages.hpp>
#include <treeform/mesh/predicates.hpp>

namespace treeform::detail::geometry {

/// Whether two points are equal; unlike ==, correct even on a processor that flushes denormals to
/// zero.
[[nodiscard]] inline bool equal_points(const point3& p, const point3& q) {
    const auto same = [](double x, double y) {
        return (exact::bit_pattern(x) - exact::bit_pattern(y)).zero;
    };
    return same(p.x, q.x) && same(p.y, q.y) && same(p.z, q.z);
}

/// Whether two of four points are equal, which is common for neighbors in a mesh.
[[nodiscard, gnu::noinline]] inline bool some_equal(const point3& a, const point3& b,
                                                    const point3& c, const point3& d) {
    return equal_points(d, a) || equal_points(d, b) || equal_points(d, c) || equal_points(a, b) ||
           equal_points(a, c) || equal_points(b, c);
}

/// The rest of `orient3d_sign` when the filter is undecided.
[[nodiscard, gnu::noinline]] inline int orient3d_undecided(const point3& a, const point3& b,
                                                           const point3& c, const point3& d,
                                                           predicate_counters* counters) {
    if (counters) ++counters->undecided;
    return some_equal(a, b, c, d) ? 0 : exact::orient3d_exact(a, b, c, d, counters);
}

/// `orient3d`, inlined.
[[nodiscard]] inline int orient3d_sign(const point3& a, const point3& b, const point3& c,
                                       const point3& d, predicate_counters* counters) {
    if (counters) ++counters->calls;
    const int sign = exact::orient3d_filter(a, b, c, d);
    return sign != exact::undecided ? sign : orient3d_undecided(a, b, c, d, counters);
}

/// `orient2d` of points already projected, inlined.
[[nodiscard]] inline int orient2d_sign(const point2& a, const point2& b, const point2& c,
                                       predicate_counters* counters) {
    if (counters) ++counters->calls;
    const int sign = exact::orient2d_filter(a, b, c);
    if (sign != exact::undecided) return sign;
    if (counters) ++counters->undecided;
    return exact::orient2d_exact(a, b, c, counters);
}

}  // namespace treeform::detail::geometry
