#pragma once
/// \file
/// Traversal of a tree by one query.

#include <treeform/tree/aabb.hpp>
#include <treeform/tree/answers.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/detail/function_ref.hpp>
#include <treeform/tree/tree.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace treeform::detail {

/// Visitor of primitives of one leaf block: those at places `first` + each bit of `mask`.
using leaf_visitor = function_ref<bool(std::uint32_t first, unsigned mask)>;

/// Calls `at_leaf(first, mask)` for the leaf blocks that are reached through the slots in
/// `mask_of(node, count)`, in leaf order, until it returns true.
template <std::size_t D, class MaskOf, class AtLeaf>
search_statistics visit_leaves(const tree<D>& tree, const MaskOf& mask_of, const AtLeaf& at_leaf) {
    struct entry {
        std::uint32_t node;
        unsigned level;
    };
    // All children of a node except the next visited are pending: 7 for each level, and the root.
    std::array<entry, 7 * 11 + 1> stack{};
    std::size_t waiting = 0;
    search_statistics seen;
    if (tree.empty()) return seen;
    stack[waiting++] = {0, 0};
    while (waiting != 0) {
        const entry at = stack[--waiting];
        const unsigned mask =
            mask_of(tree.level(at.level)[at.node], tree.child_count(at.level, at.node));
        ++seen.nodes;
        ++seen.box_tests;
        const std::uint32_t first = 8 * at.node;
        if (tree.is_leaf_level(at.level)) {
            seen.candidates += static_cast<unsigned>(std::popcount(mask));
            if (mask != 0 && at_leaf(first, mask)) break;
            continue;
        }
        for (unsigned rest = mask; rest != 0;) {  // the last first, so that the first is on top
            const auto slot = static_cast<unsigned>(std::bit_width(rest)) - 1;
            stack[waiting++] = {first + slot, at.level + 1};
            rest &= ~(1U << slot);
        }
    }
    return seen;
}

/// The same for the slots whose boxes overlap `query`, eight at a time.
TREEFORM_API search_statistics visit_box(const tree<2>& tree, const aabb<float, 2>& query,
                                         leaf_visitor at_leaf);
TREEFORM_API search_statistics visit_box(const tree<3>& tree, const aabb<float, 3>& query,
                                         leaf_visitor at_leaf);

}  // namespace treeform::detail
