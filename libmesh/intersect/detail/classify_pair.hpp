#pragma once
/// \file
/// The exact verdict on one pair of faces.

#include <libmesh/exact/counters.hpp>
#include <libmesh/intersect/self_intersections.hpp>
#include <libmesh/mesh.hpp>

#include <optional>

namespace tf::detail {

/// How faces `a` and `b` meet beyond the corners they share by number, or nothing.
[[nodiscard]] std::optional<pair_kind> classify_pair(points_view points, const face& a,
                                                     const face& b, predicate_counters& counters);

}  // namespace tf::detail
