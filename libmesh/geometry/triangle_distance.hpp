#pragma once
/// \file
/// The distance of two triangles, and where they are nearest.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/detail/export.hpp>

namespace treeform {

struct closest_between_triangles {
    point3 on_a;  ///< rounded, as is `on_b`
    point3 on_b;
    double squared_distance = 0.0;  ///< between them; exactly 0 if and only if the triangles meet
};

/// The nearest points of the closed triangles `a` and `b`.
///
/// Whether they meet is decided exactly, by `intersect`; then the distance is 0, and both points
/// are a common one, rounded. Else, with u = 2^-53 and L the largest distance between two of the
/// six corners, the distance is positive and within 8 u L of the true one: also for slivers,
/// nearly parallel edges and degenerate triangles.
///
/// \pre    coordinates are finite; squares of L are neither denormal nor infinite
/// \cost   some 800 operations; `intersect` only where the line between the points found does
///         not prove the triangles apart
[[nodiscard]] TREEFORM_API closest_between_triangles closest_points(const triangle3& a,
                                                                    const triangle3& b);

}  // namespace treeform
