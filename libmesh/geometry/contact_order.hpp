#pragma once
/// \file
/// Exact intersections of rays with triangles and first contacts of translated triangles, with
/// exact comparisons of their parameters.

#include <libmesh/exact/plane_predicates.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/detail/export.hpp>

#include <optional>

namespace treeform {

/// The first point of a ray in a triangle.
struct ray_contact {
    /// Part of the triangle that contains the first common point: `interior`, an edge or a corner.
    triangle_feature at = triangle_feature::interior;
    /// The ray is in the plane of the triangle, or the triangle has no area. If false, there is
    /// exactly one common point.
    bool coplanar = false;
    /// Parameter of the first common point, with a relative error below 2^-40; within [t_min,
    /// t_max].
    double t = 0.0;
    /// Parameter of the last common point, with the same error; equal to t when there is only one.
    double t_end = 0.0;
    /// Only when coplanar: t is t_min, and the line of the ray is in the triangle just before and
    /// just after it. Then `entry` is not set.
    bool from_start = false;
    /// A plane that meets the ray in the first common point only: defines t exactly, for `compare`.
    cutting_plane entry{};
};

/// The first point of the ray in the closed triangle; empty if they do not meet.
///
/// Exact for the given coordinates, and watertight: a ray that hits the common edge or corner of
/// two triangles hits both, and reports the edge or corner, because the side on which a line passes
/// an edge depends on the edge only. So no ray passes through a closed surface unnoticed. A
/// triangle without area is the segment or point that its corners span; features are named as by
/// `intersect` of triangles. The result does not depend on the order of the corners or the length
/// of the direction (except that features are renamed and t is scaled accordingly).
///
/// \pre    every coordinate is finite, the direction is not zero, no parameter is NaN
/// \cost   O(1), no allocation; at most 3 `direction_side` for a miss, and usually one
///         `cut_parameter` for a hit
/// \source the three signs: Segura and Feito, Algorithms to Test Ray-Triangle Intersection, WSCG
///         2001
[[nodiscard]] TREEFORM_API std::optional<ray_contact> intersect(
    const ray3& ray, const triangle3& triangle, predicate_counters* counters = nullptr);

/// The first time at which two triangles have a common point.
struct sweep_contact {
    /// Two features that meet at that time: a corner and any feature, or two edges. Others may
    /// meet, too.
    feature_pair at{triangle_feature::v0, triangle_feature::v0};
    /// With a relative error below 2^-40; 0 if and only if the exact time is 0.
    double time = 0.0;
    /// Define the time exactly, for `compare`: the time at which the point `from` of the moving
    /// triangle reaches the plane `until`.
    point3 from{};
    cutting_plane until{};
};

/// Sign of the difference of the exact parameters of two contacts of the same ray: -1 when the ray
/// reaches `a` first, 0 when both are the same point.
/// \pre both were returned by `intersect` for `ray`
[[nodiscard]] int compare(const ray3& ray, const ray_contact& a, const ray_contact& b,
                          predicate_counters* counters = nullptr);

/// The least t >= 0 for which the closed triangle `a`, moved by t d, meets the closed triangle `b`;
/// empty if there is none.
///
/// Exact for the given coordinates. For a translation the problem is linear: the moved triangles
/// meet when t d is in the convex set { y - x : x in a, y in b }, whose facets result from a corner
/// and a face or from two edges; so t is the quotient of two determinants. If that set is flat and
/// the motion is in its plane, a corner and an edge, or two corners, determine t. Degenerate
/// triangles are the segment or point that their corners span.
///
/// \pre    coordinates are finite; the triangles do not meet at t = 0: otherwise the result is some
///         t >= 0 at which they meet, not necessarily the least
/// \cost   O(1), no allocation; 18 `direction_side` and a few quotients for a hit, fewer for most
///         misses
/// \source facets of Minkowski sums: de Berg et al., Computational Geometry, chapter 13; why no
///         cubic is needed: Wang et al., A Large-Scale Benchmark and an Inclusion-Based Algorithm
///         for Continuous Collision Detection, ACM TOG 40 (2021), for the general case
[[nodiscard]] std::optional<sweep_contact> first_contact(const triangle3& a, const triangle3& b,
                                                         const point3& d,
                                                         predicate_counters* counters = nullptr);

/// Sign of the difference of the exact times of two contacts of the same motion d.
/// \pre both were returned by `first_contact` for d
[[nodiscard]] int compare(const point3& d, const sweep_contact& a, const sweep_contact& b,
                          predicate_counters* counters = nullptr);

}  // namespace treeform
