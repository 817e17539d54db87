#pragma once
/// \file
/// Traversal of any kind of tree by a box or a check.

#include <treeform/tree/aabb.hpp>
#include <treeform/tree/answers.hpp>
#include <treeform/tree/detail/box_in_space.hpp>
#include <treeform/tree/detail/visit_leaves.hpp>
#include <treeform/tree/tree.hpp>

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace treeform {

/// A query as a predicate of boxes: true if the box may contain a match.
template <class F, std::size_t D>
concept box_check = requires(const F& check, const aabb<double, D>& box) {
    { check(box) } -> std::convertible_to<bool>;
};

/// A query of `search`: a box of float or double, or a `box_check`.
template <class Q, std::size_t D>
concept tree_query =
    box_check<Q, D> || std::same_as<Q, aabb<float, D>> || std::same_as<Q, aabb<double, D>>;

namespace detail {

/// Calls `at_leaf(ids, mask)` for the leaf blocks with primitives that may match `query`: those of
/// `ids` at each bit of the mask. Stops if it returns true.
template <std::size_t D, box_check<D> Query, class AtLeaf>
search_statistics visit_query(const tree<D>& tree, const Query& query, const AtLeaf& at_leaf) {
    const std::uint32_t* const ids = tree.ids().data();
    return visit_leaves(
        tree,
        [&](const wide_node<D>& node, std::size_t count) {
            unsigned mask = 0;
            for (std::size_t slot = 0; slot < count; ++slot)
                if (node.min[0][slot] <= node.max[0][slot])  // else all below were removed
                    mask |= static_cast<unsigned>(
                                static_cast<bool>(query(box_in_space(tree.frame(), node, slot))))
                            << slot;
            return mask;
        },
        [&](std::uint32_t first, unsigned mask) { return at_leaf(ids + first, mask); });
}

template <std::size_t D, std::floating_point T, class AtLeaf>
search_statistics visit_query(const tree<D>& tree, const aabb<T, D>& query, const AtLeaf& at_leaf) {
    for (std::size_t k = 0; k < D; ++k)
        if (query.min[k] != query.min[k] || query.max[k] != query.max[k])
            throw std::invalid_argument("treeform::search: the box has a coordinate that is NaN");
    if (query.empty()) return {};
    const std::uint32_t* const ids = tree.ids().data();
    return visit_box(
        tree, box_in_frame(tree.frame(), query),
        [&](std::uint32_t first, unsigned mask) { return at_leaf(ids + first, mask); });
}

/// The slots of `mask` that have a primitive.
inline unsigned with_primitive(const std::uint32_t* ids, unsigned mask) {
    for (unsigned rest = mask; rest != 0; rest &= rest - 1)
        if (ids[std::countr_zero(rest)] == no_primitive) mask &= ~(rest & (0U - rest));
    return mask;
}

template <tree_of_trees Trees, class Query, class AtLeaf>
search_statistics visit_query(const Trees& trees, const Query& query, const AtLeaf& at_leaf) {
    search_statistics below;
    bool stopped = false;
    const auto at_block = [&](const std::uint32_t* ids, unsigned mask) {
        mask = with_primitive(ids, mask);
        return stopped = mask != 0 && at_leaf(ids, mask);
    };
    search_statistics seen =
        visit_query(trees.top(), query, [&](const std::uint32_t* parts, unsigned mask) {
            for (unsigned rest = mask; rest != 0 && !stopped; rest &= rest - 1)
                below += visit_query(trees.part(parts[std::countr_zero(rest)]), query, at_block);
            return stopped;
        });
    seen.candidates = 0;  // parts
    return seen += below;
}

}  // namespace detail

}  // namespace treeform
