#pragma once
/// \file
/// Pairs of triangles of which at least one is only a segment or a point.

#include <libmesh/exact/counters.hpp>
#include <libmesh/geometry/detail/view_axis.hpp>
#include <libmesh/geometry/triangle_triangle.hpp>

#include <optional>

namespace tf::detail {

/// `intersect` when `a` or `b` or both are degenerate, that is, have no view axis.
[[nodiscard]] triangle_contact intersect_degenerate(const triangle3& a,
                                                    const std::optional<view_axis>& of_a,
                                                    const triangle3& b,
                                                    const std::optional<view_axis>& of_b,
                                                    predicate_counters* counters);

}  // namespace tf::detail
