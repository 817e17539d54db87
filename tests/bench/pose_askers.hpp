#pragma once
/// \file
/// The questions about poses by treeform, and by the paper's layout and searches.

#include "bench/poses.hpp"
#include <libtree/tree_config.hpp>

#include <cstdint>

namespace tf::bench {

/// With the default trees and the ready-made functions of libmesh.
[[nodiscard]] ask_pose own_collide(const scene& scene);
[[nodiscard]] ask_pose own_intersect(const scene& scene);
[[nodiscard]] ask_pose own_distance(const scene& scene);

/// With `nary_tree` and its searches; boxes of the second tree are turned where they are looked at.
/// Pairs of faces are decided by the same exact test, after their boxes.
[[nodiscard]] ask_pose paper_collide(const scene& scene);
[[nodiscard]] ask_pose paper_intersect(const scene& scene);

enum class open_by { top_k, heap };
/// `inspected`, where given, counts pairs of boxes whose distance was taken.
[[nodiscard]] ask_pose paper_distance(const scene& scene, open_by order,
                                      const tree_config& config = {},
                                      std::uint64_t* inspected = nullptr);

}  // namespace tf::bench
