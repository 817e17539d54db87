#pragma once
/// \file
/// Overlap searches. One query (a box, or a function that tests boxes) in any kind of tree:
/// `search`, `search_any`, `search_all`, and `search_broad` for blocks. All pairs of primitives of
/// one tree whose boxes overlap, each once: `search_self`, `search_self_any`, `search_self_all`,
/// `search_self_broad`. For two trees, see `search_pair.hpp`.

#include <treeform/tree/answers.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/detail/function_ref.hpp>
#include <treeform/tree/detail/pairs_by_ids.hpp>
#include <treeform/tree/detail/search_chunks.hpp>
#include <treeform/tree/detail/visit_query.hpp>
#include <treeform/tree/search_pair.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace treeform {

/// Calls `apply(id)` for the primitives that match `query`, in leaf order, until `apply` returns
/// true (it may also return nothing). Returns counts of visited nodes and boxes.
///
/// `query` is a box or a check. A box matches the primitives whose boxes overlap it, touching
/// included. A check is a function that gets a box, in the coordinates of the primitives, and
/// returns whether to accept it. A check that accepts a box must accept every larger box around it.
/// It matches the primitives whose boxes it accepts. These boxes are those of the tree, rounded
/// outward: no match is missed, but some primitives match only because of the rounding. An empty
/// box matches nothing; an infinite box is valid.
///
/// \throws std::invalid_argument if a box has a NaN coordinate
/// \cost   O(log N + P) for P matches, if the query is not larger than the primitives
/// \same   in every run; runs on the calling thread, and any number of searches may run
///         concurrently
/// \source Sajovic, Knez and Korez, tf::tree, section III-C
template <any_tree Tree, tree_query<Tree::dimensions> Query, class Apply>
search_statistics search(const Tree& tree, const Query& query, const Apply& apply) {
    return detail::visit_query(tree, query, [&](const std::uint32_t* ids, unsigned mask) {
        for (unsigned rest = mask; rest != 0; rest &= rest - 1)
            if (detail::asks_to_stop(apply, ids[std::countr_zero(rest)])) return true;
        return false;
    });
}

/// The same for leaf blocks: `apply(ids)` gets the up to 8 primitives of a block that match, as a
/// `std::span<const std::uint32_t>`.
template <any_tree Tree, tree_query<Tree::dimensions> Query, class Apply>
search_statistics search_broad(const Tree& tree, const Query& query, const Apply& apply) {
    return detail::visit_query(tree, query, [&](const std::uint32_t* ids, unsigned mask) {
        std::array<std::uint32_t, 8> wanted;
        std::size_t count = 0;
        for (unsigned rest = mask; rest != 0; rest &= rest - 1)
            wanted[count++] = ids[std::countr_zero(rest)];
        return detail::asks_to_stop(apply, std::span<const std::uint32_t>(wanted.data(), count));
    });
}

/// Whether `accept(id)` is true for some primitive that matches `query`.
template <any_tree Tree, tree_query<Tree::dimensions> Query, class Accept>
[[nodiscard]] bool search_any(const Tree& tree, const Query& query, const Accept& accept) {
    bool found = false;
    search(tree, query, [&](std::uint32_t id) { return found = accept(id); });
    return found;
}

/// The primitives that match `query` and for which `accept(id)` is true, ascending.
template <any_tree Tree, tree_query<Tree::dimensions> Query, class Accept>
[[nodiscard]] std::vector<std::uint32_t> search_all(const Tree& tree, const Query& query,
                                                    const Accept& accept) {
    std::vector<std::uint32_t> found;
    search(tree, query, [&](std::uint32_t id) {
        if (accept(id)) found.push_back(id);
    });
    std::sort(found.begin(), found.end());
    return found;
}

/// The primitives that match `query`, ascending.
template <any_tree Tree, tree_query<Tree::dimensions> Query>
[[nodiscard]] std::vector<std::uint32_t> search_all(const Tree& tree, const Query& query) {
    return search_all(tree, query, [](std::uint32_t) { return true; });
}

namespace detail {

/// A set of nodes of a tree.
template <std::size_t D>
class node_marks {
  public:
    /// The empty set.
    explicit node_marks(const tree<D>& tree) : marks_(tree.levels()) {
        for (unsigned level = 0; level < tree.levels(); ++level)
            marks_[level].resize(tree.nodes_in_level(level));
    }

    [[nodiscard]] bool operator()(unsigned level, std::size_t node) const {
        return marks_[level][node] != 0;
    }
    /// May be called for different nodes at once.
    void mark(unsigned level, std::size_t node) { marks_[level][node] = 1; }

  private:
    std::vector<std::vector<std::uint8_t>> marks_;  ///< [levels][nodes]
};

}  // namespace detail

/// The search of a tree against itself, cut into chunks that depend on the tree alone.
///
/// The caller runs the chunks, usually with `for_chunks(search.chunks(), 1, ...)`, and keeps a
/// state of its own for each: chunks share nothing, and joining the states in order gives the same
/// result on any number of threads.
///
/// \source Sajovic, Knez and Korez, tf::tree, section III-C; one box against eight at a time
template <std::size_t D>
class TREEFORM_API self_search_chunks {
  public:
    /// \pre `tree` outlives the search and is not rebuilt meanwhile
    explicit self_search_chunks(const tree<D>& tree) : self_search_chunks(tree, nullptr) {}

    /// Omits pairs of two primitives below the same marked node.
    /// \pre also `skipped` outlives the search
    self_search_chunks(const tree<D>& tree, const detail::node_marks<D>& skipped)
        : self_search_chunks(tree, &skipped) {}

    [[nodiscard]] std::size_t chunks() const;

    /// Calls `visit` for the blocks of one chunk, in order, until it returns false. All chunks
    /// together have every pair of primitives whose boxes overlap (touching counts) exactly once,
    /// and some whose boxes miss by less than the rounding of the tree's float boxes.
    ///
    /// \cost over all chunks O(N + pairs of overlapping nodes + P) for P candidates
    search_statistics visit(std::size_t chunk,
                            detail::function_ref<bool(const candidate_block&)> visit) const;

  private:
    self_search_chunks(const tree<D>& tree, const detail::node_marks<D>* skipped);

    const tree<D>* tree_;
    const detail::node_marks<D>* skipped_;
    unsigned level_ = 0;  ///< level of the nodes in `items_`
    std::vector<detail::node_pair> items_;
};

namespace detail {

template <std::size_t D>
[[nodiscard]] auto self_pairs(const tree<D>& tree) {
    const std::uint32_t* const ids = tree.ids().data();
    return pairs_of_tree(self_search_chunks<D>(tree), ids, ids);
}

/// The pairs of parts that may have pairs of primitives, ascending; each part is also paired with
/// itself.
template <tree_of_trees Trees>
[[nodiscard]] std::vector<id_pair> self_pairs_of_parts(const Trees& trees) {
    auto parts = all_pairs<true>(self_pairs(trees.top()), every_pair);
    for (const std::uint32_t part : trees.top().ids()) parts.emplace_back(part, part);
    std::sort(parts.begin(), parts.end());
    return parts;
}

template <tree_of_trees Trees>
[[nodiscard]] auto self_pairs(const Trees& trees) {
    constexpr std::size_t D = Trees::dimensions;
    pairs_of_parts<self_search_chunks<D>, pair_search_chunks<D>> pairs;
    const auto add = [&](std::uint32_t x, std::uint32_t y) {
        const tree<D>&a = trees.part(x), &b = trees.part(y);
        if (x == y)
            pairs.add(self_search_chunks<D>(a), a.ids().data(), a.ids().data());
        else
            pairs.add(pair_search_chunks<D>(a, b), a.ids().data(), b.ids().data());
    };
    const auto prepare = [&](std::uint32_t x, std::uint32_t y) {
        (void)trees.part(x);
        (void)trees.part(y);
    };
    for_parts(self_pairs_of_parts(trees), prepare, add);
    return pairs;
}

}  // namespace detail

/// Calls `apply(state, a, b)` for every pair of primitives a, b whose boxes overlap; for a `tree`,
/// a is earlier in leaf order. `apply` is called from several threads; each chunk has its own
/// state, made by `State{}`. Returns the states, in an order that depends on the tree alone. If
/// `apply` returns true (it may also return nothing), the search stops: the state of that call is
/// the last one returned, and the states contain what a single thread would have found by then.
template <class State, any_tree Tree, class Apply>
[[nodiscard]] std::vector<State> search_self(const Tree& tree, const Apply& apply) {
    return detail::pair_states<State>(detail::self_pairs(tree), apply);
}

/// The same for a `tree`, in blocks of candidates, `apply(state, block)`, to test several at once.
/// A block has positions in leaf order, not ids.
template <class State, std::size_t D, class Apply>
[[nodiscard]] std::vector<State> search_self_broad(const tree<D>& tree, const Apply& apply) {
    return detail::search_states<State>(self_search_chunks<D>(tree),
                                        [&](State& state, const candidate_block& block) {
                                            return detail::asks_to_stop(apply, state, block);
                                        });
}

/// Whether `accept(a, b)` is true for some pair of primitives whose boxes overlap. `accept` is
/// called from several threads, until a pair is found.
template <any_tree Tree, class Accept>
[[nodiscard]] bool search_self_any(const Tree& tree, const Accept& accept) {
    if constexpr (tree_of_trees<Tree>)
        return detail::any_of_parts(
            detail::self_pairs_of_parts(tree), accept, [&](auto x, auto y, const auto& accepted) {
                return x == y ? search_self_any(tree.part(x), accepted)
                              : search_any(tree.part(x), tree.part(y), accepted);
            });
    else
        return detail::search_for_any(
            self_search_chunks<Tree::dimensions>(tree), [&](const candidate_block& block) {
                const std::uint32_t* const ids = tree.ids().data();
                return detail::any_of_block<false>(block, ids, ids, accept);
            });
}

/// The pairs (a, b), a < b, of primitives whose boxes overlap and for which `accept(a, b)` is true,
/// ascending. `accept` is called from several threads.
template <any_tree Tree, class Accept>
[[nodiscard]] std::vector<id_pair> search_self_all(const Tree& tree, const Accept& accept) {
    return detail::all_pairs<true>(detail::self_pairs(tree), accept);
}

/// The pairs whose boxes, as stored in the tree, overlap.
template <any_tree Tree>
[[nodiscard]] std::vector<id_pair> search_self_all(const Tree& tree) {
    return search_self_all(tree, detail::every_pair);
}

}  // namespace treeform
