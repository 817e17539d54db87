#pragma once
/// \file
/// When a triangle in straight motion first meets another; the order of contacts, exactly.

#include <treeform/mesh/predicates.hpp>

#include <optional>

namespace treeform {

/// Sign of the difference of the exact parameters of two contacts of one ray: -1 when the ray gets
/// to `a` first, 0 when both are the same point.
/// \pre both were returned by `intersect` for `ray`
[[nodiscard]] int compare(const ray3& ray, const ray_contact& a, const ray_contact& b,
                          predicate_counters* counters = nullptr);

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
///         cubic is needed: Wang et al., A Large-Scale Benchmark and an Inclusion-Based Algorithm
///         for Continuous Collision Detection, ACM TOG 40 (2021), for the general case
[[nodiscard]] std::optional<sweep_contact> first_contact(const triangle3& a, const triangle3& b,
                                                         const point3& d,
                                                         predicate_counters* counters = nullptr);

/// Sign of the difference of the exact times of two contacts under one motion d.
/// \pre both were returned by `first_contact` for d
[[nodiscard]] int compare(const point3& d, const sweep_contact& a, const sweep_contact& b,
                          predicate_counters* counters = nullptr);

}  // namespace treeform
