#pragma once
/// \file
/// The invariants of the paper's tree as a function.

#include <libtree/paper/nary_tree.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/build.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace treeform {

/// The reason why `tree` is not a valid tree over `boxes`, or none. In a valid tree every primitive
/// is in one leaf, boxes are exact, and leaves are not too large.
template <class T, std::size_t D>
[[nodiscard]] std::optional<std::string> why_malformed(const nary_tree<T, D>& tree,
                                                       std::span<const aabb<T, D>> boxes) {
    if (tree.ids.size() != boxes.size()) return "wrong size";
    if (!detail::is_permutation(tree.ids)) return "ids are no permutation";
    if (boxes.empty()) return std::nullopt;
    std::size_t next = 0;  // leaves hold consecutive ranges
    std::vector<std::size_t> stack{0};
    while (!stack.empty()) {
        const std::size_t n = stack.back();
        const nary_node<T, D>& node = tree.nodes[n];
        stack.pop_back();
        aabb<T, D> box;
        if (node.axis < 0) {
            if (node.offset != next) return "leaf " + std::to_string(n) + " is out of order";
            if (node.size > tree.config.leaf_size)
                return "leaf " + std::to_string(n) + " is too large";
            for (std::size_t i = 0; i < node.size; ++i) box.include(boxes[tree.ids[next + i]]);
            next += node.size;
        } else {
            if (node.offset != tree.config.inner_size * n + 1)
                return "children of node " + std::to_string(n) + " are misplaced";
            for (std::size_t c = node.size; c-- > 0;) {
                box.include(tree.nodes[node.offset + c].box);
                stack.push_back(node.offset + c);
            }
        }
        if (!(box == node.box)) return "box of node " + std::to_string(n) + " is wrong";
    }
    return next == boxes.size() ? std::nullopt : std::optional<std::string>("a leaf is missing");
}

}  // namespace treeform
