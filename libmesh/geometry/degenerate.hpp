#pragma once
/// \file
/// Intersection of two triangles of which at least one is a segment or a point.

#include <libmesh/geometry/view_axis.hpp>
#include <treeform/mesh/predicates.hpp>

#include <optional>

namespace treeform::detail::geometry {

/// `intersect` when `a` or `b` or both are degenerate, that is, have no view axis.
[[nodiscard]] triangle_contact intersect_degenerate(const triangle3& a,
                                                    const std::optional<view_axis>& of_a,
                                                    const triangle3& b,
                                                    const std::optional<view_axis>& of_b,
                                                    predicate_counters* counters);

}  // namespace treeform::detail::geometry
