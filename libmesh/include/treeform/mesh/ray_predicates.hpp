#pragma once
/// \file
/// Signs about a line given by a point and a direction, exact for all finite doubles; and the
/// parameter at which such a line meets a plane.
///
/// The line is { o + t d }, with d taken as the vector it is: no point o + d is ever rounded. What
/// predicates.hpp says of its functions holds for these, too.

#include <treeform/mesh/counters.hpp>
#include <treeform/mesh/point.hpp>
#include <treeform/tree/export.hpp>

namespace treeform {

/// Sign of ((b - a) x (c - a)) . d: +1 when d points to the side of the plane a, b, c that its
/// normal points to, 0 when d is parallel to the plane. With a = o: +1 when the line o + t d, seen
/// against its direction, passes to the left of the directed line b -> c, 0 when they are coplanar.
[[nodiscard]] TREEFORM_API int direction_side(const point3& a, const point3& b, const point3& c,
                                              const point3& d,
                                              predicate_counters* counters = nullptr);

/// Sign of component `axis` (0, 1 or 2) of d x (p - o): +1 when p lies to the left of the line
/// o + t d, both projected along the axis as by `orient2d`.
[[nodiscard]] TREEFORM_API int line_side(int axis, const point3& o, const point3& d,
                                         const point3& p, predicate_counters* counters = nullptr);

/// A plane through a point along two vectors, each the difference of two points. Its normal is
/// (u_to - u_from) x (v_to - v_from).
struct cutting_plane {
    point3 at;
    point3 u_from, u_to;
    point3 v_from, v_to;
};

/// Sign of t - s for the parameters t, s at which the line o + t d meets planes p and q.
/// \pre d points to the positive side of both: their normals . d > 0
[[nodiscard]] TREEFORM_API int compare_cuts(const point3& o, const point3& d,
                                            const cutting_plane& p, const cutting_plane& q,
                                            predicate_counters* counters = nullptr);

/// The same for two lines of one direction: t at which o + t d meets p, s at which r + s d meets q.
[[nodiscard]] TREEFORM_API int compare_cuts(const point3& d, const point3& o,
                                            const cutting_plane& p, const point3& r,
                                            const cutting_plane& q,
                                            predicate_counters* counters = nullptr);

/// Sign of t - s for the parameter t at which the line o + t d meets plane p.
/// \pre normal . d > 0, s is finite
[[nodiscard]] TREEFORM_API int compare_cut(const point3& o, const point3& d, const cutting_plane& p,
                                           double s, predicate_counters* counters = nullptr);

/// The parameter at which the line o + t d meets plane p, with a relative error below 2^-40: its
/// sign is right, and it is 0 where the exact one is. Beyond the range of double, infinite or 0.
/// \pre  normal . d != 0
/// \cost as a predicate: double arithmetic where that can be so good, otherwise integers
[[nodiscard]] TREEFORM_API double cut_parameter(const point3& o, const point3& d,
                                                const cutting_plane& p);

}  // namespace treeform
