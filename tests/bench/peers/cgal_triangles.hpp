#pragma once
/// \file
/// Pairs of triangles by CGAL: the kind of their intersection, and their squared distance.

#include "bench/peers/cgal_predicates.hpp"
#include "support/stress_families.hpp"

#include <span>
#include <vector>

namespace treeform::bench {

/// What the intersection of two triangles may be said to be, beside the number of ends.
inline constexpr signed char kind_failed = -1;  ///< an exception

/// [pairs] 0 apart, 1 a point, 2 a segment, 3 an area: as `CGAL::intersection` constructs each
/// pair; with the kernel EPECK exact, with EPICK in double.
[[nodiscard]] verdicts cgal_kinds(std::span<const test::triangle_pair> pairs, bool exact);

}  // namespace treeform::bench
