#pragma once
/// \file
/// Predicates by CGAL.

#include "support/stress_families.hpp"

#include <functional>
#include <span>
#include <vector>

namespace treeform::bench {

/// What is asked of a pair of triangles a, b.
enum class question {
    orient2d,          ///< of a0, a1, b0, their z left out
    orient3d,          ///< of a0, a1, a2, b0
    collinear,         ///< a0, a1, b0
    compare_along,     ///< sign of (a1 - a0) . (b1 - b0)
    compare_distance,  ///< |a0 a1| against |b0 b1|
    triangles_meet     ///< whether they have a common point; neither is degenerate
};

/// [pairs] a sign, or 1 for yes and 0 for no.
using verdicts = std::vector<signed char>;

/// Answers the question for all pairs, whose corners were converted to points of a kernel before:
/// Exact_predicates_inexact_constructions_kernel and Exact_predicates_exact_constructions_kernel.
using asker = std::function<void(verdicts&)>;
[[nodiscard]] asker cgal_filtered(question question, std::span<const test::triangle_pair> pairs);
[[nodiscard]] asker cgal_exact(question question, std::span<const test::triangle_pair> pairs);

}  // namespace treeform::bench
