#pragma once
/// \file
/// Search of a tree by a box, or by anything that can be held against a box. With the headers
/// included here, all searches: `search`, `search_broad`, `search_any`, `search_all` of one tree
/// and of two; `search_self`, `search_self_broad`, `search_self_any`, `search_self_all`; and
/// `search_any_broad` of two trees.

#include <treeform/tree/aabb.hpp>
#include <treeform/tree/answers.hpp>
#include <treeform/tree/detail/visit_leaves.hpp>
#include <treeform/tree/search_pair.hpp>
#include <treeform/tree/search_self.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

namespace treeform {

/// A query that can be held against boxes: true where something in the box may be wanted.
template <class F, std::size_t D>
concept box_check = requires(const F& check, const aabb<double, D>& box) {
    { check(box) } -> std::convertible_to<bool>;
};

namespace detail {

/// A box of space that holds box `slot` of `node`. Below, the sum with the origin is off by at most
/// 2^-53 of itself, the subtraction of the margin by as much, and scaling by less than 1e-307.
template <std::size_t D>
[[nodiscard]] aabb<double, D> box_in_space(const tree_frame<D>& frame, const wide_node<D>& node,
                                           std::size_t slot) {
    constexpr double largest = std::numeric_limits<double>::max();
    // Where the build had to clamp, a side that faces inward says only that the coordinate is that
    // far out or differs from the origin by more than the largest double.
    const auto difference = [&](float side) { return static_cast<double>(side) / frame.scale; };
    const auto outward = [](double x) { return 0x1p-51 * std::abs(x) + 1e-306; };
    aabb<double, D> box;
    for (std::size_t k = 0; k < D; ++k) {
        const double low = std::min(difference(node.min[k][slot]), largest) + frame.origin[k];
        const double high = std::max(difference(node.max[k][slot]), -largest) + frame.origin[k];
        box.min[k] = std::min(low, largest) - outward(std::min(low, largest));
        box.max[k] = std::max(high, -largest) + outward(std::max(high, -largest));
    }
    return box;
}

/// `box` in a frame, rounded outward: the difference is off by 2^-53 of itself, the float nearest
/// to it by 2^-24, or below the least normal float by less than 1.2e-38, and 1.2e-7 > 2^-23 covers
/// both and the rounding of the sum. A coordinate beyond the range of float moves out to infinity;
/// inward it stays at the end of the range, where the build clamps what lies as far out.
template <std::size_t D, std::floating_point T>
[[nodiscard]] aabb<float, D> box_in_frame(const tree_frame<D>& frame, const aabb<T, D>& box) {
    const auto nearest = [&](double x, std::size_t k) {
        constexpr double limit = std::numeric_limits<float>::max();
        return static_cast<float>(std::clamp((x - frame.origin[k]) * frame.scale, -limit, limit));
    };
    const auto margin = [](float f) { return std::abs(f) * 1.2e-7F + 1e-37F; };
    aabb<float, D> rounded;
    for (std::size_t k = 0; k < D; ++k) {
        const float low = nearest(static_cast<double>(box.min[k]), k);
        const float high = nearest(static_cast<double>(box.max[k]), k);
        rounded.min[k] = low - margin(low);
        rounded.max[k] = high + margin(high);
    }
    return rounded;
}

/// Calls `at_leaf(first, mask)` for the leaf blocks with primitives that `query` may want.
template <std::size_t D, box_check<D> Query, class AtLeaf>
search_statistics visit_query(const tree<D>& tree, const Query& query, const AtLeaf& at_leaf) {
    return visit_leaves(
        tree,
        [&](const wide_node<D>& node, std::size_t count) {
            unsigned mask = 0;
            for (std::size_t slot = 0; slot < count; ++slot)
                if (node.min[0][slot] <= node.max[0][slot])  // else all below has been removed
                    mask |= static_cast<unsigned>(
                                static_cast<bool>(query(box_in_space(tree.frame(), node, slot))))
                            << slot;
            return mask;
        },
        at_leaf);
}

template <std::size_t D, std::floating_point T, class AtLeaf>
search_statistics visit_query(const tree<D>& tree, const aabb<T, D>& query, const AtLeaf& at_leaf) {
    for (std::size_t k = 0; k < D; ++k)
        if (query.min[k] != query.min[k] || query.max[k] != query.max[k])
            throw std::invalid_argument("treeform::search: the box has a coordinate that is NaN");
    if (query.empty()) return {};
    return visit_box(tree, box_in_frame(tree.frame(), query), at_leaf);
}

}  // namespace detail

/// What a search of one tree takes: a box of float or double, or a `box_check`.
template <class Q, std::size_t D>
concept tree_query =
    box_check<Q, D> || std::same_as<Q, aabb<float, D>> || std::same_as<Q, aabb<double, D>>;

/// Calls `apply(id)` for the primitives that `query` may want, in leaf order, until it returns true
/// (it may return nothing). Returns what was looked at.
///
/// A box wants the primitives whose boxes overlap it, touching included. A check, called with boxes
/// in the coordinates of the primitives, wants what lies below nodes and in boxes for which it is
/// true; it must be true for a box around any box for which it is. Boxes are those of the tree,
/// rounded outward: none is missed, and some come that miss by less than that rounding. An empty
/// box wants nothing, an infinite one may be asked for.
///
/// \throws std::invalid_argument when a box has a coordinate that is NaN
/// \cost   O(log N + P) for P primitives, on a query no larger than they are
/// \same   in every run; runs on the calling thread, and any number may run at the same time
/// \source Sajovic, Knez and Korez, tf::tree, section III-C
template <std::size_t D, tree_query<D> Query, class Apply>
search_statistics search(const tree<D>& tree, const Query& query, const Apply& apply) {
    return detail::visit_query(tree, query, [&](std::uint32_t first, unsigned mask) {
        for (unsigned rest = mask; rest != 0; rest &= rest - 1)
            if (detail::asks_to_stop(
                    apply, tree.ids()[first + static_cast<unsigned>(std::countr_zero(rest))]))
                return true;
        return false;
    });
}

/// The same a leaf block at a time: `apply(ids)` with the up to 8 primitives of a block that the
/// query may want, as a `std::span<const std::uint32_t>`.
template <std::size_t D, tree_query<D> Query, class Apply>
search_statistics search_broad(const tree<D>& tree, const Query& query, const Apply& apply) {
    return detail::visit_query(tree, query, [&](std::uint32_t first, unsigned mask) {
        std::array<std::uint32_t, 8> ids;
        std::size_t count = 0;
        for (unsigned rest = mask; rest != 0; rest &= rest - 1)
            ids[count++] = tree.ids()[first + static_cast<unsigned>(std::countr_zero(rest))];
        return detail::asks_to_stop(apply, std::span<const std::uint32_t>(ids.data(), count));
    });
}

/// Whether `accept(id)` is true for a primitive that `query` may want. Of any tree that there is a
/// `search` of one query for: a `tree`, a `lazy_tree`, a `dynamic_tree`.
template <class Tree, tree_query<Tree::dimensions> Query, class Accept>
[[nodiscard]] bool search_any(const Tree& tree, const Query& query, const Accept& accept) {
    bool found = false;
    search(tree, query, [&](std::uint32_t id) { return found = accept(id); });
    return found;
}

/// The primitives that `query` may want and for which `accept(id)` is true, ascending; of any tree,
/// as `search_any`.
template <class Tree, tree_query<Tree::dimensions> Query, class Accept>
[[nodiscard]] std::vector<std::uint32_t> search_all(const Tree& tree, const Query& query,
                                                    const Accept& accept) {
    std::vector<std::uint32_t> found;
    search(tree, query, [&](std::uint32_t id) {
        if (accept(id)) found.push_back(id);
    });
    std::sort(found.begin(), found.end());
    return found;
}

/// The primitives that `query` may want, ascending.
template <class Tree, tree_query<Tree::dimensions> Query>
[[nodiscard]] std::vector<std::uint32_t> search_all(const Tree& tree, const Query& query) {
    return search_all(tree, query, [](std::uint32_t) { return true; });
}

}  // namespace treeform
