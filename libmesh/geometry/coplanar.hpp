#pragma once
/// \file
/// Intersection of two coplanar triangles: the corners of the common polygon, in order.

#include <libmesh/geometry/view_axis.hpp>
#include <treeform/mesh/predicates.hpp>

namespace treeform::detail::geometry {

/// `intersect` for coplanar triangles, neither degenerate; `of_a` is a view axis of `a`, hence
/// of `b` too.
[[nodiscard]] triangle_contact intersect_coplanar(const triangle3& a, view_axis of_a,
                                                  const triangle3& b, predicate_counters* counters);

}  // namespace treeform::detail::geometry
