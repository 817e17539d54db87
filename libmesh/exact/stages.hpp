#pragma once
/// \file
/// The exact stage by itself, compiled: for loops that inline the filter (detail/filter.hpp) and
/// call only when it left the sign open.
///
/// Counts the width it took; calls and undecided ones are counted by who ran the filter.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>

namespace treeform::detail::exact {

[[nodiscard]] int orient2d_exact(const point2& a, const point2& b, const point2& c,
                                 predicate_counters* counters);

[[nodiscard]] int orient2d_exact(int axis, const point3& a, const point3& b, const point3& c,
                                 predicate_counters* counters);

[[nodiscard]] int orient3d_exact(const point3& a, const point3& b, const point3& c, const point3& d,
                                 predicate_counters* counters);

}  // namespace treeform::detail::exact
