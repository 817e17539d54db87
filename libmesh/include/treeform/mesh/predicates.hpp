#pragma once
/// \file
/// Signs of polynomials in the coordinates of given points, exact for all finite doubles.
///
/// A function that returns int returns -1, 0 or +1: the sign of the real number in the first line
/// of its comment, evaluated without rounding on the coordinates as given. A floating-point filter
/// answers most calls; what it leaves undecided is evaluated in integers, on the smallest
/// power-of-two lattice that holds the coordinates of that call. No tolerance, no state, no
/// allocation, no exception; safe to call from any thread, in any rounding mode, with denormals
/// flushed or not.
///
/// \pre for all: coordinates are finite. An optional `counters` counts the calls and their stages.
/// \source filters: Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust
///         Geometric Predicates, DCG 18 (1997), section 4; permanents as in Burnikel, Funke and
///         Seel, Exact Geometric Computation Using Cascading, IJCGA 11 (2001)
///
/// Exact intersection of two triangles, and the type of rays. Triangles include their edges.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/ray.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace treeform {

/// Counts of predicate calls. Each thread has its own, and the caller adds them up.
struct predicate_counters {
    /// Widths of the exact stage: 128-bit words, then 1, 2, 4, 8, 16 and 33 limbs a coordinate.
    static constexpr std::size_t widths = 7;

    std::uint64_t calls = 0;      ///< predicates called
    std::uint64_t undecided = 0;  ///< calls that the filter left undecided
    /// undecided calls, by the width that decided them
    std::array<std::uint64_t, widths> by_width{};

    predicate_counters& operator+=(const predicate_counters& other) {
        calls += other.calls;
        undecided += other.undecided;
        for (std::size_t i = 0; i < widths; ++i) by_width[i] += other.by_width[i];
        return *this;
    }
};

}  // namespace treeform

#ifdef __FAST_MATH__
#error "treeform decides with IEEE arithmetic; do not compile it with -ffast-math"
#endif

namespace treeform {

/// Sign of (b - a) x (c - a): +1 when a, b, c turn left (counter-clockwise), 0 when collinear.
[[nodiscard]] TREEFORM_API int orient2d(const point2& a, const point2& b, const point2& c,
                                        predicate_counters* counters = nullptr);

/// `orient2d` of the projections along `axis` (0, 1 or 2): the other two coordinates, in cyclic
/// order (y, z), (z, x) or (x, y). It is the sign of component `axis` of (b - a) x (c - a).
[[nodiscard]] TREEFORM_API int orient2d(int axis, const point3& a, const point3& b, const point3& c,
                                        predicate_counters* counters = nullptr);

/// Sign of ((b - a) x (c - a)) . (d - a): +1 when d lies on the side of the plane a, b, c that its
/// normal points to, that is, from where a, b, c are seen counter-clockwise; 0 when coplanar.
[[nodiscard]] TREEFORM_API int orient3d(const point3& a, const point3& b, const point3& c,
                                        const point3& d, predicate_counters* counters = nullptr);

/// Whether a, b and c lie on one line (equal points do).
[[nodiscard]] TREEFORM_API bool collinear(const point3& a, const point3& b, const point3& c,
                                          predicate_counters* counters = nullptr);

/// Sign of |a - b|^2 - |c - d|^2.
[[nodiscard]] TREEFORM_API int compare_distance(const point3& a, const point3& b, const point3& c,
                                                const point3& d,
                                                predicate_counters* counters = nullptr);

using triangle3 = std::array<point3, 3>;

/// A part of a triangle. Edge `e0` runs from v0 to v1, `e1` from v1 to v2, `e2` from v2 to v0;
/// `interior` is the triangle without its edges.
enum class triangle_feature : std::uint8_t { v0, v1, v2, e0, e1, e2, interior };

/// A point of both triangles, named by the lowest-dimensional feature of each that it lies on. An
/// end of the intersection is on a corner or an edge of at least one of the two.
struct feature_pair {
    triangle_feature on_a;
    triangle_feature on_b;
    friend constexpr bool operator==(const feature_pair&, const feature_pair&) = default;
};

/// The intersection of two triangles.
struct triangle_contact {
    /// All six corners lie in one plane. Degenerate triangles count: two collinear ones are
    /// coplanar when their lines meet or are parallel, a point is coplanar with any segment.
    bool coplanar = false;
    /// Both triangles have a plane, each has corners strictly on both sides of the other's, and
    /// the common segment has length: the triangles pass through each other.
    bool crossing = false;
    /// Number of `ends` of the intersection: 0 if it is empty, 1 for a point, 2 for a segment, 3 to
    /// 6 for the corners of a convex area, counter-clockwise seen from the side to which the normal
    /// of `a` points.
    std::uint8_t count = 0;
    std::array<feature_pair, 6> ends{};  ///< the first `count` are set; no two are equal
};

/// The intersection of the closed triangles `a` and `b`.
///
/// Exact on the coordinates as given: no verdict depends on a tolerance, on the order of the
/// corners or on which triangle comes first (features are renamed accordingly; the order of `ends`
/// may differ). Equal corners are a common point like any other, so neighbors in a mesh report at
/// least what they share. A degenerate triangle is the segment or the point that its corners span,
/// and never has an interior. A point on it is named by the lowest-numbered corner there, else by
/// the lowest-numbered edge that contains it.
///
/// \pre    every coordinate is finite
/// \cost   O(1), no allocation; at most 10 `orient3d` unless the triangles are coplanar or one is
///         degenerate, and at most 6 when a plane separates them; for coplanar ones 6 `orient3d`
///         and at most 25 `orient2d`
/// \source Devillers and Guigue, Faster Triangle-Triangle Intersection Tests, INRIA RR-4488 (2002),
///         for the plane and interval tests
[[nodiscard]] TREEFORM_API triangle_contact intersect(const triangle3& a, const triangle3& b,
                                                      predicate_counters* counters = nullptr);

/// The points origin + t direction, t_min <= t <= t_max, with nothing rounded: t is a real number.
using ray3 = ray<double, 3>;

}  // namespace treeform
