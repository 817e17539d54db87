#pragma once
/// \file
/// Signs of polynomials in the coordinates of given points, exact for all finite doubles.
///
/// Every function returns -1, 0 or +1: the sign of the real number its first line names, evaluated
/// without rounding on the coordinates as given. A floating-point filter answers most calls; what
/// it leaves open is evaluated in integers on the smallest power-of-two lattice that holds the
/// coordinates of that call. No tolerance, no state, no allocation, no exception; safe to call
/// from any thread, in any rounding mode, with denormals flushed or not.
///
/// \pre of all: coordinates are finite. An optional `counters` collects what the call cost.
/// \source filters: Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust
///         Geometric Predicates, DCG 18 (1997), section 4; permanents as in Burnikel, Funke and
///         Seel, Exact Geometric Computation Using Cascading, IJCGA 11 (2001)

#include <treeform/mesh/counters.hpp>
#include <treeform/mesh/point.hpp>
#include <treeform/tree/export.hpp>

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

/// Sign of (b - a) . (d - c): along the direction from a to b, d lies ahead of c (+1), behind (-1).
[[nodiscard]] TREEFORM_API int compare_along(const point3& a, const point3& b, const point3& c,
                                             const point3& d,
                                             predicate_counters* counters = nullptr);

/// Sign of |a - b|^2 - |c - d|^2.
[[nodiscard]] TREEFORM_API int compare_distance(const point3& a, const point3& b, const point3& c,
                                                const point3& d,
                                                predicate_counters* counters = nullptr);

/// Three corners that span a plane; its normal is (b - a) x (c - a).
struct plane_points {
    point3 a, b, c;
};

/// Sign of n . m for the normals n, m of two planes: +1 when they face the same half-space.
[[nodiscard]] TREEFORM_API int normal_dot(const plane_points& p, const plane_points& q,
                                          predicate_counters* counters = nullptr);

/// Sign of (n x m) . (b - a) for the normals n, m of two planes: the order of two half-planes
/// about the directed edge a -> b (radial sort).
[[nodiscard]] TREEFORM_API int normal_turn(const plane_points& p, const plane_points& q,
                                           const point3& a, const point3& b,
                                           predicate_counters* counters = nullptr);

/// Sign of (n x m) . k for the normals of three planes: 0 when they share a direction.
[[nodiscard]] TREEFORM_API int normal_determinant(const plane_points& p, const plane_points& q,
                                                  const plane_points& r,
                                                  predicate_counters* counters = nullptr);

}  // namespace treeform
