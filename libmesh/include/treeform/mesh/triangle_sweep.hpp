#pragma once
/// \file
/// When a triangle in straight motion first meets another, exactly.

#include <treeform/mesh/counters.hpp>
#include <treeform/mesh/ray_predicates.hpp>
#include <treeform/mesh/triangle_triangle.hpp>
#include <treeform/tree/export.hpp>

#include <cstdint>
#include <optional>

namespace treeform {

/// The first time at which two triangles have a common point.
struct sweep_contact {
    /// A point of each that meet then, among others: a corner and any feature, or two edges.
    contact at{feature::v0, feature::v0};
    /// With a relative error below 2^-40; 0 exactly when it is 0.
    double time = 0.0;
    /// The time as an exact number, for `compare`: when the point `from` of the moving triangle,
    /// carried along, gets to the plane `until`.
    point3 from{};
    cutting_plane until{};
};

/// The least t >= 0 for which the closed triangle `a`, moved by t d, meets the closed triangle `b`;
/// none when there is no such t.
///
/// Exact on the coordinates as given. A translation makes this linear: moved triangles meet when
/// t d lies in the convex set { y - x : x in a, y in b }, whose facets come from a corner and a
/// face or from two edges, so t is the quotient of two determinants. Where that set is flat and
/// the motion runs in its plane, a corner and an edge, or two corners, give t. Degenerate
/// triangles are the segment or point that their corners span.
///
/// \pre    coordinates are finite; the triangles do not meet at t = 0, or else the answer is some
///         t >= 0 at which they meet, not the least
/// \cost   O(1), no allocation; 18 `direction_side` and a few quotients for a hit, fewer for most
///         misses
/// \source facets of Minkowski sums: de Berg et al., Computational Geometry, chapter 13; why no
/// cubic
///         is needed: Wang et al., A Large-Scale Benchmark and an Inclusion-Based Algorithm for
///         Continuous Collision Detection, ACM TOG 40 (2021), for the general case
[[nodiscard]] TREEFORM_API std::optional<sweep_contact> first_contact(
    const triangle3& a, const triangle3& b, const point3& d,
    predicate_counters* counters = nullptr);

/// Sign of the difference of the exact times of two contacts under one motion d.
/// \pre both are what `first_contact` gave for d
[[nodiscard]] TREEFORM_API int compare(const point3& d, const sweep_contact& a,
                                       const sweep_contact& b,
                                       predicate_counters* counters = nullptr);

}  // namespace treeform
