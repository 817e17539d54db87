#pragma once
/// \file
/// The questions about poses by treeform, and by the paper's layout and searches.

#include "bench/poses.hpp"
#include <libtree/paper/tree_config.hpp>

#include <cstdint>
#include <memory>

namespace treeform::bench {

/// With the default trees and the ready-made functions of libmesh.
[[nodiscard]] ask_pose own_collide(const scene& scene);
[[nodiscard]] ask_pose own_intersect(const scene& scene);
[[nodiscard]] ask_pose own_distance(const scene& scene);

/// With `nary_tree` and its searches; boxes of the second tree are turned where they are looked at.
/// Pairs of faces are decided by the same exact test, after their boxes.
[[nodiscard]] ask_pose paper_collide(const scene& scene);
[[nodiscard]] ask_pose paper_intersect(const scene& scene);

enum class open_by { top_k, heap };
/// What a search has cost so far.
struct box_count {
    std::uint64_t boxes = 0;  ///< pairs of boxes whose distance was taken
    std::uint64_t poses = 0;
};
/// `counted`, where given, grows with each answer.
[[nodiscard]] ask_pose paper_distance(const scene& scene, open_by order,
                                      const tree_config& config = {},
                                      std::shared_ptr<box_count> counted = nullptr);

}  // namespace treeform::bench
