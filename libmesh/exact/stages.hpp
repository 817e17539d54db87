#pragma once
/// \file
/// The exact stage as separate functions, for loops that inline the filter (filter.hpp) and call
/// these only when it is undecided.
///
/// Counts the width used; the caller, which runs the filter, counts calls and undecided ones.

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
