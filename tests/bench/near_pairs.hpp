#pragma once
/// \file
/// Clouds with near copies of some of their points, and who is within reach of whom.

#include "bench/workload.hpp"
#include <libtree/paper/nary_tree.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/answers.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace treeform::bench {

using shared_cloud = std::shared_ptr<const std::vector<point3>>;

/// Copies are moved by this much in a random direction.
inline constexpr double copy_distance = 1e-4;
/// Points this near make a pair: a little more, so that rounding decides nothing.
inline constexpr double reach = 1.001 * copy_distance;

/// `points` in all, uniform in the unit cube, of which `percent` per cent are copies of others. The
/// one that was asked for last is kept while somebody uses it.
[[nodiscard]] shared_cloud cloud_with_copies(std::size_t points, unsigned percent);

/// How many pairs there are, by sorting along one axis.
[[nodiscard]] std::size_t near_pair_count(const std::vector<point3>& points);

/// A pair of the answers.
using pair_lists = std::vector<std::vector<id_pair>>;
[[nodiscard]] std::size_t count_of(const pair_lists& lists);

/// The tree over boxes about the points that overlap where the points are within reach.
[[nodiscard]] tree<3> reach_tree(const std::vector<point3>& points);
[[nodiscard]] pair_lists near_pairs(const tree<3>& tree, const std::vector<point3>& points);

/// The same in the paper's layout, with its search: boxes are the points, and checked for their
/// distance.
[[nodiscard]] nary_tree<double, 3> paper_point_tree(const std::vector<point3>& points);
[[nodiscard]] pair_lists near_pairs(const nary_tree<double, 3>& tree,
                                    const std::vector<point3>& points);

}  // namespace treeform::bench
