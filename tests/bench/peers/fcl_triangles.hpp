#pragma once
/// \file
/// Pairs of triangles by FCL's own routines, which its trees call at their leaves.

#include "bench/peers/cgal_predicates.hpp"
#include "support/stress_families.hpp"

#include <functional>
#include <span>
#include <vector>

namespace treeform::bench {

/// `Intersect::intersect_Triangle` in float or in double, corners converted before.
[[nodiscard]] asker fcl_triangles_meet(std::span<const test::triangle_pair> pairs, bool in_float);

/// [pairs] `TriangleDistance::triDistance` in float or in double.
[[nodiscard]] std::function<void(std::vector<double>&)> fcl_triangle_distances(
    std::span<const test::triangle_pair> pairs, bool in_float);

}  // namespace treeform::bench
