#pragma once
/// \file
/// Signs of polynomials in the coordinates of given points, exact for all finite doubles.
///
/// Every function returns -1, 0 or +1: the sign of the real number its first line names, evaluated
/// without rounding on the coordinates as given. A floating-point filter answers most calls; what
/// it leaves undecided is evaluated in integers, on the smallest power-of-two lattice that holds
/// the coordinates of that call. No tolerance, no state, no allocation, no exception; safe to call
/// from any thread, in any rounding mode, with denormals flushed or not.
///
/// \pre for all: coordinates are finite. An optional `counters` collects what the call cost.
/// \source filters: Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust
///         Geometric Predicates, DCG 18 (1997), section 4; permanents as in Burnikel, Funke and
///         Seel, Exact Geometric Computation Using Cascading, IJCGA 11 (2001)

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace treeform {

/// Counts of predicate calls. Each thread has its own, and the caller adds them up.
struct predicate_counters {
    /// Widths of the exact stage: 128-bit words, then 1, 2, 4, 8, 16 and 33 limbs a coordinate.
    static constexpr std::size_t widths = 7;

    std::uint64_t calls = 0;                       ///< predicates called
    std::uint64_t undecided = 0;                   ///< of these, undecided by the filter
    std::array<std::uint64_t, widths> by_width{};  ///< of these, decided exactly at each width

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

/// A plane through a point along two vectors, each the difference of two points. Its normal is
/// (u_to - u_from) x (v_to - v_from).
struct cutting_plane {
    point3 at;
    point3 u_from, u_to;
    point3 v_from, v_to;
};

}  // namespace treeform
