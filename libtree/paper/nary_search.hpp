#pragma once
/// \file
/// The paper's searches of its own tree: the caller's function checks boxes, one pair at a time.
/// For reproducing and comparing the paper's figures, and for queries of two trees whose boxes need
/// a test other than overlap.
///
/// \source Sajovic, Knez and Korez, tf::tree, section III-C and Algorithm 2

#include <libtree/paper/nary_tree.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/search_chunks.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace treeform {
namespace detail {

template <class T, std::size_t D>
std::span<const std::uint32_t> ids_of_leaf(const nary_tree<T, D>& tree, std::size_t node) {
    return std::span(tree.ids).subspan(tree.nodes[node].offset, tree.nodes[node].size);
}

/// Algorithm 2 on two trees, or on one tree with itself: then each pair of different nodes occurs
/// once.
template <class T, std::size_t D, class Check>
class nary_pair_search {
  public:
    using ids = std::span<const std::uint32_t>;

    nary_pair_search(const nary_tree<T, D>& a, const nary_tree<T, D>& b, const Check& check)
        : a_(a), b_(b), check_(check), self_(&a == &b) {
        if (a.ids.empty() || b.ids.empty() || !wanted(0, 0)) return;
        items_ = {{0, 0}};
        bool opened = true;
        while (opened && items_.size() < enough_items) {
            opened = false;
            std::vector<node_pair> below;
            const auto keep = [&](std::size_t x, std::size_t y) {
                below.push_back({static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)});
                return true;
            };
            for (const node_pair item : items_)
                if (leaf_a(item.a) && leaf_b(item.b))
                    below.push_back(item);
                else
                    opened = true, open(item.a, item.b, keep);
            items_ = std::move(below);
        }
    }

    [[nodiscard]] std::size_t chunks() const { return chunk_count(items_.size(), items_per_chunk); }

    /// Calls `visit(ids_a, ids_b)` for pairs of leaves until it returns false.
    template <class Visit>
    void visit(std::size_t chunk, const Visit& visit) const {
        const std::size_t begin = chunk * items_per_chunk;
        const std::size_t end = std::min(begin + items_per_chunk, items_.size());
        for (std::size_t i = begin; i < end; ++i)
            if (!descend(items_[i].a, items_[i].b, visit)) return;
    }

  private:
    static constexpr std::size_t enough_items = 2048;
    static constexpr std::size_t items_per_chunk = 16;

    [[nodiscard]] bool leaf_a(std::size_t x) const { return a_.nodes[x].axis < 0; }
    [[nodiscard]] bool leaf_b(std::size_t y) const { return b_.nodes[y].axis < 0; }
    [[nodiscard]] bool wanted(std::size_t x, std::size_t y) const {
        return (self_ && x == y) || check_(a_.nodes[x].box, b_.nodes[y].box);
    }

    /// Calls `inner(x, y)` for the accepted pairs below, until it returns false.
    template <class Inner>
    bool open(std::size_t x, std::size_t y, const Inner& inner) const {
        const auto& of_x = a_.nodes[x];
        const auto& of_y = b_.nodes[y];
        const auto pass = [&](std::size_t c, std::size_t d) {
            return !wanted(c, d) || inner(c, d);
        };
        if (leaf_a(x)) {
            for (std::size_t j = 0; j < of_y.size; ++j)
                if (!pass(x, of_y.offset + j)) return false;
        } else if (leaf_b(y)) {
            for (std::size_t i = 0; i < of_x.size; ++i)
                if (!pass(of_x.offset + i, y)) return false;
        } else {
            for (std::size_t i = 0; i < of_x.size; ++i)
                for (std::size_t j = self_ && x == y ? i : 0; j < of_y.size; ++j)
                    if (!pass(of_x.offset + i, of_y.offset + j)) return false;
        }
        return true;
    }

    template <class Visit>
    bool descend(std::size_t x, std::size_t y, const Visit& visit) const {
        if (leaf_a(x) && leaf_b(y)) return visit(ids_of_leaf(a_, x), ids_of_leaf(b_, y));
        return open(x, y, [&](std::size_t c, std::size_t d) { return descend(c, d, visit); });
    }

    const nary_tree<T, D>& a_;
    const nary_tree<T, D>& b_;
    const Check& check_;
    bool self_;
    std::vector<node_pair> items_;
};

}  // namespace detail

/// Calls `apply(ids)`, with a `std::span<const std::uint32_t>`, for the primitives of each leaf for
/// which `check_aabb(box)` is true on its box and all boxes above it, until `apply` returns true.
template <class T, std::size_t D, class Check, class Apply>
void search_broad(const nary_tree<T, D>& tree, const Check& check_aabb, const Apply& apply) {
    if (tree.ids.empty()) return;
    std::vector<std::size_t> stack{0};
    while (!stack.empty()) {
        const std::size_t at = stack.back();
        const auto& node = tree.nodes[at];
        stack.pop_back();
        if (!check_aabb(node.box)) continue;
        if (node.axis < 0) {
            if (detail::asks_to_stop(apply, detail::ids_of_leaf(tree, at))) return;
        } else {
            for (std::size_t i = node.size; i-- > 0;) stack.push_back(node.offset + i);
        }
    }
}

/// The same for single primitives: `apply(id)` for all primitives of each such leaf.
template <class T, std::size_t D, class Check, class Apply>
void search(const nary_tree<T, D>& tree, const Check& check_aabb, const Apply& apply) {
    search_broad(tree, check_aabb, [&](std::span<const std::uint32_t> ids) {
        return std::ranges::any_of(
            ids, [&](std::uint32_t id) { return detail::asks_to_stop(apply, id); });
    });
}

/// Calls `apply(state, ids_a, ids_b)` for the pairs of leaves for which `check_aabbs(box_a, box_b)`
/// is true on their boxes and on the boxes above. States and stopping are as in `search` of two
/// trees: one state for each chunk, the same on any number of threads. `check_aabbs` is called from
/// several threads.
template <class State, class T, std::size_t D, class Check, class Apply>
[[nodiscard]] std::vector<State> search_broad(const nary_tree<T, D>& a, const nary_tree<T, D>& b,
                                              const Check& check_aabbs, const Apply& apply) {
    using ids = std::span<const std::uint32_t>;
    return detail::search_states<State>(detail::nary_pair_search(a, b, check_aabbs),
                                        [&](State& state, ids of_a, ids of_b) {
                                            return detail::asks_to_stop(apply, state, of_a, of_b);
                                        });
}

/// The same for pairs of primitives: `apply(state, a, b)` for all pairs of two such leaves.
template <class State, class T, std::size_t D, class Check, class Apply>
[[nodiscard]] std::vector<State> search(const nary_tree<T, D>& a, const nary_tree<T, D>& b,
                                        const Check& check_aabbs, const Apply& apply) {
    using ids = std::span<const std::uint32_t>;
    return search_broad<State>(a, b, check_aabbs, [&](State& state, ids of_a, ids of_b) {
        for (const std::uint32_t x : of_a)
            for (const std::uint32_t y : of_b)
                if (detail::asks_to_stop(apply, state, x, y)) return true;
        return false;
    });
}

/// The same for one tree: each pair of different leaves once, and each leaf with itself.
template <class State, class T, std::size_t D, class Check, class Apply>
[[nodiscard]] std::vector<State> search_self_broad(const nary_tree<T, D>& tree,
                                                   const Check& check_aabbs, const Apply& apply) {
    return search_broad<State>(tree, tree, check_aabbs, apply);
}

/// The same for pairs of primitives: each pair of different primitives once.
template <class State, class T, std::size_t D, class Check, class Apply>
[[nodiscard]] std::vector<State> search_self(const nary_tree<T, D>& tree, const Check& check_aabbs,
                                             const Apply& apply) {
    using ids = std::span<const std::uint32_t>;
    return search_self_broad<State>(tree, check_aabbs, [&](State& state, ids of_a, ids of_b) {
        const bool same = of_a.data() == of_b.data();
        for (std::size_t i = 0; i < of_a.size(); ++i)
            for (std::size_t j = same ? i + 1 : 0; j < of_b.size(); ++j)
                if (detail::asks_to_stop(apply, state, of_a[i], of_b[j])) return true;
        return false;
    });
}

}  // namespace treeform
