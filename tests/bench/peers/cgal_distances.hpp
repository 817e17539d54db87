#pragma once
/// \file
/// Distances of points and triangles by CGAL, rounded and exact.

#include "support/stress_families.hpp"

#include <functional>
#include <span>
#include <vector>

namespace treeform::bench {

/// Of pairs of triangles a, b.
enum class distance_question {
    point_triangle,    ///< from b0 to a
    triangle_triangle  ///< from a to b
};

/// [pairs] distances.
using distance_asker = std::function<void(std::vector<double>&)>;

/// `CGAL::squared_distance` with the kernel EPICK, which constructs in double.
[[nodiscard]] distance_asker cgal_rounded_distances(distance_question question,
                                                    std::span<const test::triangle_pair> pairs);
/// The same with EPECK, evaluated exactly, and the root of it in double.
[[nodiscard]] distance_asker cgal_exact_distances(distance_question question,
                                                  std::span<const test::triangle_pair> pairs);

/// A distance and the double nearest to it.
struct true_distance {
    double rounded = 0.0;
    double rest = 0.0;  ///< what `rounded` is short of the distance, to 50 bits
};
[[nodiscard]] std::vector<true_distance> cgal_true_distances(
    distance_question question, std::span<const test::triangle_pair> pairs);

}  // namespace treeform::bench
