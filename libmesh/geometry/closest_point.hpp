#pragma once
/// \file
/// The point of a triangle nearest to a given point.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/detail/export.hpp>

namespace treeform {

struct closest_on_triangle {
    point3 point;                   ///< on the triangle, rounded
    double squared_distance = 0.0;  ///< squared distance from the query to `point`
};

/// The point of the closed triangle `t` that is nearest to `p`, computed in double.
///
/// With u = 2^-53 and L the largest distance between any two of the four points, the square root of
/// `squared_distance` is within 8 u L of the true distance. This holds for slivers and needles of
/// any aspect ratio, and for degenerate triangles, which are the segment or point that their
/// corners span. No exact decisions are needed: a wrong one causes only a rounding error.
///
/// \pre    coordinates are finite; squares of L are neither denormal nor infinite
/// \cost   about 70 operations, no allocation
[[nodiscard]] TREEFORM_API closest_on_triangle closest_point(const triangle3& t, const point3& p);

namespace detail::geometry {

struct based_triangle;

/// The squared distance of `closest_point`, for a triangle with many queries.
[[nodiscard]] double squared_distance(const based_triangle& t, const point3& p);

}  // namespace detail::geometry

}  // namespace treeform
