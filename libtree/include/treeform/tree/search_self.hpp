#pragma once
/// \file
/// Search of a tree by itself: every pair of primitives whose boxes overlap, once.

#include <treeform/tree/answers.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/detail/function_ref.hpp>
#include <treeform/tree/detail/search_chunks.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace treeform {

/// The search of a tree by itself, cut into chunks that depend on the tree alone.
///
/// The caller runs the chunks, as a rule with `for_chunks(search.chunks(), 1, ...)`, and keeps a
/// state of its own for each: chunks share nothing, and joining the states in order gives the same
/// result on any number of threads.
///
/// \source Sajovic, Knez and Korez, tf::tree, section III-C; one box against eight at a time
template <std::size_t D>
class TREEFORM_API self_search {
  public:
    /// \pre `tree` outlives the search and is not rebuilt meanwhile
    explicit self_search(const tree<D>& tree);

    [[nodiscard]] std::size_t chunks() const;

    /// Calls `visit` for the blocks of one chunk, in order, until it returns false. All chunks
    /// together hold every pair of primitives whose boxes overlap (touching counts) exactly once,
    /// and some whose boxes miss by less than the rounding of the tree's float boxes.
    ///
    /// \cost over all chunks O(N + pairs of overlapping nodes + P) for P candidates
    search_statistics visit(std::size_t chunk,
                            detail::function_ref<bool(const candidate_block&)> visit) const;

  private:
    const tree<D>* tree_;
    unsigned level_ = 0;  ///< of the nodes that the items pair
    std::vector<detail::node_pair> items_;
};

/// Calls `apply(state, a, b)` for every pair of primitives a, b of the range the tree was built
/// over whose boxes overlap, a at the earlier place in leaf order. Returns the states, one a chunk,
/// in an order that depends on the tree alone: no state is shared between threads, `apply` is
/// called by several. A state is made by `State{}` and moved. Where `apply` returns true (it may
/// return nothing), the search stops: the state it was given is the last of those returned, and
/// they hold what one thread would have found.
template <class State, std::size_t D, class Apply>
[[nodiscard]] std::vector<State> search_self(const tree<D>& tree, const Apply& apply) {
    const auto id = tree.ids();
    return detail::search_states<State>(
        self_search<D>(tree), [&](State& state, const candidate_block& block) {
            for (std::size_t i = 0; i < block.first.size(); ++i)
                if (detail::asks_to_stop(apply, state, id[block.first[i]], id[block.second[i]]))
                    return true;
            return false;
        });
}

/// The same by blocks of candidates, `apply(state, block)`: for those who test several at once. A
/// block names places in leaf order, not ids.
template <class State, std::size_t D, class Apply>
[[nodiscard]] std::vector<State> search_self_broad(const tree<D>& tree, const Apply& apply) {
    return detail::search_states<State>(self_search<D>(tree),
                                        [&](State& state, const candidate_block& block) {
                                            return detail::asks_to_stop(apply, state, block);
                                        });
}

/// Whether `accept(a, b)` is true for some pair of primitives whose boxes overlap; it is called
/// from several threads, and no more once a pair is known.
template <std::size_t D, class Accept>
[[nodiscard]] bool search_self_any(const tree<D>& tree, const Accept& accept) {
    const auto id = tree.ids();
    return detail::search_for_any(self_search<D>(tree), [&](const candidate_block& block) {
        for (std::size_t i = 0; i < block.first.size(); ++i)
            if (accept(id[block.first[i]], id[block.second[i]])) return true;
        return false;
    });
}

/// The pairs (a, b), a < b, of primitives whose boxes overlap and for which `accept(a, b)` is true,
/// ascending. `accept` is called from several threads.
template <std::size_t D, class Accept>
[[nodiscard]] std::vector<id_pair> search_self_all(const tree<D>& tree, const Accept& accept) {
    using pairs = std::vector<id_pair>;
    pairs all = detail::joined(
        search_self<pairs>(tree, [&](pairs& found, std::uint32_t a, std::uint32_t b) {
            if (b < a) std::swap(a, b);
            if (accept(a, b)) found.emplace_back(a, b);
        }));
    std::sort(all.begin(), all.end());
    return all;
}

/// The pairs whose boxes, as the tree holds them, overlap.
template <std::size_t D>
[[nodiscard]] std::vector<id_pair> search_self_all(const tree<D>& tree) {
    return search_self_all(tree, [](std::uint32_t, std::uint32_t) { return true; });
}

}  // namespace treeform
