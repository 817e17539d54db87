#pragma once
/// \file
/// Exact classification of a pair of faces or triangles.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <optional>

namespace treeform::detail::intersect {

/// How faces `a` and `b` meet beyond corners with equal numbers; none if they do not.
[[nodiscard]] std::optional<pair_kind> classify_pair(points_view points, const face& a,
                                                     const face& b, predicate_counters& counters);

/// How two triangles meet that share no corner by number; none if they do not.
[[nodiscard]] std::optional<pair_kind> classify_triangles(const triangle3& a, const triangle3& b,
                                                          predicate_counters& counters);

}  // namespace treeform::detail::intersect
