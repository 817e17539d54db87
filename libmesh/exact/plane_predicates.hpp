#pragma once
/// \file
/// Exact predicates on normals of planes, directions and intersections of lines with planes, like
/// those of the public header.

#include <treeform/mesh/predicates.hpp>

namespace treeform {

/// Sign of (b - a) . (d - c): along the direction from a to b, d lies ahead of c (+1), behind (-1).
[[nodiscard]] int compare_along(const point3& a, const point3& b, const point3& c, const point3& d,
                                predicate_counters* counters = nullptr);

/// Three corners that span a plane; its normal is (b - a) x (c - a).
struct plane_points {
    point3 a, b, c;
};

/// Sign of n . m for the normals n, m of two planes: +1 when they face the same half-space.
[[nodiscard]] int normal_dot(const plane_points& p, const plane_points& q,
                             predicate_counters* counters = nullptr);

/// Sign of (n x m) . (b - a) for the normals n, m of two planes: the order of two half-planes
/// about the directed edge a -> b (radial sort).
[[nodiscard]] int normal_turn(const plane_points& p, const plane_points& q, const point3& a,
                              const point3& b, predicate_counters* counters = nullptr);

/// Sign of (n x m) . k for the normals n, m, k of three planes: 0 when the planes are parallel to a
/// common line.
[[nodiscard]] int normal_determinant(const plane_points& p, const plane_points& q,
                                     const plane_points& r, predicate_counters* counters = nullptr);

/// Sign of ((b - a) x (c - a)) . d: +1 when d points to the side of the plane a, b, c that its
/// normal points to, 0 when d is parallel to the plane. With a = o: +1 when the line o + t d, seen
/// against its direction, passes to the left of the directed line b -> c, 0 when they are coplanar.
[[nodiscard]] int direction_side(const point3& a, const point3& b, const point3& c, const point3& d,
                                 predicate_counters* counters = nullptr);

/// Sign of component `axis` (0, 1 or 2) of d x (p - o): +1 when p lies to the left of the line
/// o + t d, both projected along the axis as by `orient2d`.
[[nodiscard]] int line_side(int axis, const point3& o, const point3& d, const point3& p,
                            predicate_counters* counters = nullptr);

/// A plane through a point along two vectors, each the difference of two points. Its normal is
/// (u_to - u_from) x (v_to - v_from).
struct cutting_plane {
    point3 at;
    point3 u_from, u_to;
    point3 v_from, v_to;
};

/// Sign of t - s for the parameters t, s at which the line o + t d meets planes p and q.
/// \pre d points to the positive side of both: their normals . d > 0
[[nodiscard]] int compare_cuts(const point3& o, const point3& d, const cutting_plane& p,
                               const cutting_plane& q, predicate_counters* counters = nullptr);

/// The same for two parallel lines: t at which o + t d meets p, s at which r + s d meets q.
[[nodiscard]] int compare_cuts(const point3& d, const point3& o, const cutting_plane& p,
                               const point3& r, const cutting_plane& q,
                               predicate_counters* counters = nullptr);

/// Sign of t - s for the parameter t at which the line o + t d meets plane p.
/// \pre normal . d > 0, s is finite
[[nodiscard]] int compare_cut(const point3& o, const point3& d, const cutting_plane& p, double s,
                              predicate_counters* counters = nullptr);

/// The parameter at which the line o + t d meets plane p, with a relative error below 2^-40. Its
/// sign is exact, and it is 0 if the exact parameter is 0. Infinite or 0 beyond the range of
/// double.
/// \pre  normal . d != 0
/// \cost as a predicate: double arithmetic if that is accurate enough, otherwise integers
[[nodiscard]] double cut_parameter(const point3& o, const point3& d, const cutting_plane& p);

}  // namespace treeform
