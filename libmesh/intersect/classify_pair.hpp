#pragma once
/// \file
/// The exact verdict on one pair of faces, or of triangles.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <optional>

namespace treeform::detail::intersect {

/// How faces `a` and `b` meet beyond the corners they share by number, or nothing.
[[nodiscard]] std::optional<pair_kind> classify_pair(points_view points, const face& a,
                                                     const face& b, predicate_counters& counters);

/// How two triangles meet that share no corner by number, or nothing.
[[nodiscard]] std::optional<pair_kind> classify_triangles(const triangle3& a, const triangle3& b,
                                                          predicate_counters& counters);

}  // namespace treeform::detail::intersect
