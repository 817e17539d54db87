#pragma once
/// \file
/// What two closed triangles have in common, exactly, with every end point named.

#include <treeform/mesh/counters.hpp>
#include <treeform/mesh/point.hpp>
#include <treeform/tree/export.hpp>

#include <array>
#include <cstdint>

namespace treeform {

using triangle3 = std::array<point3, 3>;

/// A part of a triangle. Edge `e0` runs from v0 to v1, `e1` from v1 to v2, `e2` from v2 to v0;
/// `interior` is the triangle without its edges.
enum class feature : std::uint8_t { v0, v1, v2, e0, e1, e2, interior };

/// A point of both triangles, named by the lowest-dimensional feature of each that it lies on.
/// An end of the common set is on a corner or an edge of at least one of the two.
struct contact {
    feature on_a;
    feature on_b;
    friend constexpr bool operator==(const contact&, const contact&) = default;
};

/// The dimension of the common set.
enum class overlap : std::uint8_t { none, point, segment, area };

struct triangle_contact {
    overlap kind = overlap::none;
    /// All six corners lie in one plane. Degenerate triangles count: two collinear ones are
    /// coplanar when their lines meet or are parallel, a point is coplanar with any segment.
    bool coplanar = false;
    /// Both triangles have a plane, each has corners strictly on both sides of the other's, and
    /// the common segment has length: the triangles pass through each other.
    bool crossing = false;
    /// Ends of the common set: none, 1 point, 2 ends of a segment, or the 3 to 6 corners of a
    /// convex area in counter-clockwise order, seen from the side that the normal of `a` points to.
    std::uint8_t count = 0;
    std::array<contact, 6> ends{};  ///< the first `count` are set; no two are equal
};

/// The intersection of the closed triangles `a` and `b`.
///
/// Exact on the coordinates as given: no verdict depends on a tolerance, on the order of the
/// corners or on which triangle comes first (features are renamed accordingly; the order of `ends`
/// may differ). Corners with equal coordinates are met like any other point, so neighbours in a
/// mesh report at least what they share. A degenerate triangle is the segment or the point that
/// its corners span, and never has an interior; a point on it is named by its lowest-numbered
/// corner there, else by the lowest-numbered edge that holds it.
///
/// \pre    every coordinate is finite
/// \cost   O(1), no allocation; at most 10 `orient3d` unless the triangles are coplanar or one is
///         degenerate, and at most 6 when a plane separates them; for coplanar ones 6 `orient3d`
///         and at most 25 `orient2d`
/// \source Devillers and Guigue, Faster Triangle-Triangle Intersection Tests, INRIA RR-4488 (2002),
///         for the plane and interval tests
[[nodiscard]] TREEFORM_API triangle_contact intersect(const triangle3& a, const triangle3& b,
                                                      predicate_counters* counters = nullptr);

}  // namespace treeform
