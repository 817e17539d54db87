#pragma once
/// \file
/// Checks the invariants of a tree.

#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/frame.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace treeform {

namespace detail {

/// Whether `ids` holds each of 0 ... N-1 once.
[[nodiscard]] inline bool is_permutation(std::span<const std::uint32_t> ids) {
    std::vector<bool> seen(ids.size(), false);
    for (const std::uint32_t id : ids) {
        if (id >= ids.size() || seen[id]) return false;
        seen[id] = true;
    }
    return true;
}

/// Whether slot `slot` of `node` holds, in the frame of the tree, all of `box`.
template <class T, std::size_t D>
[[nodiscard]] bool slot_holds(const wide_node<D>& node, std::size_t slot, const aabb<T, D>& box,
                              const tree_frame<D>& frame) {
    // The exact image of the box lies within one rounding of what is computed here; a slot that
    // holds the computed one without any slack was not rounded outward.
    // An infinite side holds everything, also what overflows here.
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (std::size_t k = 0; k < D; ++k) {
        const double lo = (static_cast<double>(box.min[k]) - frame.origin[k]) * frame.scale;
        const double hi = (static_cast<double>(box.max[k]) - frame.origin[k]) * frame.scale;
        const float min = node.min[k][slot], max = node.max[k][slot];
        if (!(static_cast<double>(min) < lo) && min != -infinity) return false;
        if (!(static_cast<double>(max) > hi) && max != infinity) return false;
    }
    return true;
}

}  // namespace detail

/// What is wrong with `tree` as a tree over `boxes`; none when it is valid: the ids are a
/// permutation, every leaf slot holds the box of its primitive, every inner slot the boxes below
/// it, and no other slot is in use.
template <std::size_t D, class T>
[[nodiscard]] std::optional<std::string> why_malformed(const tree<D>& tree,
                                                       std::span<const aabb<T, D>> boxes) {
    const auto at = [](const char* what, unsigned level, std::size_t node, std::size_t slot) {
        return std::string(what) + " at level " + std::to_string(level) + ", node " +
               std::to_string(node) + ", slot " + std::to_string(slot);
    };
    if (tree.size() != boxes.size() || tree.ids().size() != boxes.size()) return "wrong size";
    if (!detail::is_permutation(tree.ids())) return "ids are no permutation";
    if (tree.empty()) return std::nullopt;
    const auto is_clear = [](const wide_node<D>& node, std::size_t slot) {
        for (std::size_t k = 0; k < D; ++k)
            if (!(node.min[k][slot] > node.max[k][slot])) return false;
        return true;
    };
    for (unsigned level = 0; level < tree.levels(); ++level)
        for (std::size_t n = 0; n < tree.nodes_in_level(level); ++n) {
            const wide_node<D>& node = tree.level(level)[n];
            const bool leaf = tree.is_leaf_level(level);
            const std::size_t used = tree.children(level, n);
            for (std::size_t slot = 0; slot < tree.width; ++slot) {
                if (slot >= used) {
                    if (!is_clear(node, slot)) return at("slot should be empty", level, n, slot);
                } else if (leaf) {
                    const aabb<T, D>& box = boxes[tree.ids()[n * tree.width + slot]];
                    if (!detail::slot_holds(node, slot, box, tree.frame()))
                        return at("box is cut off", level, n, slot);
                } else {
                    const wide_node<D>& child = tree.level(level + 1)[n * tree.width + slot];
                    for (std::size_t k = 0; k < D; ++k)
                        if (node.min[k][slot] !=
                                *std::min_element(child.min[k], child.min[k] + tree.width) ||
                            node.max[k][slot] !=
                                *std::max_element(child.max[k], child.max[k] + tree.width))
                            return at("box is not that of the children", level, n, slot);
                }
            }
        }
    return std::nullopt;
}

}  // namespace treeform
