#pragma once
/// \file
/// Search of a tree by itself: every pair of primitives whose boxes overlap, once.

#include <libtree/candidates.hpp>
#include <libtree/detail/function_ref.hpp>
#include <libtree/export.hpp>
#include <libtree/parallel.hpp>
#include <libtree/tree.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tf {
namespace detail {

/// Two nodes of one level, or twice the same, whose candidate pairs are wanted.
struct node_pair {
    std::uint32_t a, b;
};

}  // namespace detail

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
    void visit(std::size_t chunk, detail::function_ref<bool(const candidate_block&)> visit) const;

  private:
    const tree<D>* tree_;
    unsigned level_ = 0;  ///< of the nodes that the items pair
    std::vector<detail::node_pair> items_;
};

/// Calls `apply(state, a, b)` for every pair of primitives a, b of the range the tree was built
/// over whose boxes overlap. Returns the states, one a chunk, in an order that depends on the tree
/// alone: no state is shared between threads. When `apply` returns true, the search stops: the
/// state it was given is the last of those returned, and they hold what one thread would have
/// found.
template <class State, std::size_t D, class Apply>
[[nodiscard]] std::vector<State> search_self(const tree<D>& tree, const Apply& apply) {
    const self_search<D> search(tree);
    std::vector<State> states(search.chunks());
    std::atomic<std::size_t> last{states.size()};  // the first chunk that asked to stop
    for_chunks(search.chunks(), 1, [&](std::size_t chunk, std::size_t, std::size_t) {
        search.visit(chunk, [&](const candidate_block& block) {
            if (chunk > last.load(std::memory_order_relaxed)) return false;
            for (std::size_t i = 0; i < block.first.size(); ++i)
                if (apply(states[chunk], tree.ids()[block.first[i]], tree.ids()[block.second[i]])) {
                    std::size_t seen = last.load();
                    while (chunk < seen && !last.compare_exchange_weak(seen, chunk)) {
                    }
                    return false;
                }
            return true;
        });
    });
    if (last.load() < states.size()) states.resize(last.load() + 1);
    return states;
}

}  // namespace tf
