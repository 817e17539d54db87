#pragma once
/// \file
/// The distance of two triangles, and their closest points.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/detail/export.hpp>

namespace treeform {

struct closest_between_triangles {
    point3 on_a;  ///< rounded, as is `on_b`
    point3 on_b;
    /// squared distance; exactly 0 if and only if the triangles meet
    double squared_distance = 0.0;
};

/// The closest points of the closed triangles `a` and `b`.
///
/// Whether they meet is decided exactly, by `intersect`. If so, the distance is 0, and both points
/// are the same common point, rounded. Otherwise the distance is positive and within 8 u L of the
/// true one, with u = 2^-53 and L the largest distance between two of the six corners; this
/// includes slivers, nearly parallel edges and degenerate triangles.
///
/// \pre    coordinates are finite; squares of L are neither denormal nor infinite
/// \cost   about 800 operations; `intersect` only if the line between the points found does not
///         separate the triangles
[[nodiscard]] TREEFORM_API closest_between_triangles closest_pair(const triangle3& a,
                                                                  const triangle3& b);

}  // namespace treeform
