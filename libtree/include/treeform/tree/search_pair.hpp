#pragma once
/// \file
/// Overlap searches of two trees of any kind. They find each pair of primitives, one of each tree,
/// whose boxes overlap: `search`, `search_any`, `search_all`, and `search_broad` for blocks.

#include <treeform/tree/answers.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/detail/frame_map.hpp>
#include <treeform/tree/detail/function_ref.hpp>
#include <treeform/tree/detail/pairs_by_ids.hpp>
#include <treeform/tree/detail/search_chunks.hpp>
#include <treeform/tree/detail/trees_side.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform {

namespace detail {

/// Two trees, and the maps of their boxes to the frame in which they are compared.
template <std::size_t D>
struct two_trees {
    const tree<D>* a;
    const tree<D>* b;
    frame_map<D> map_a;
    frame_map<D> map_b;
    /// Whether boxes are also compared in the frame of the moved tree; by the maps `own_a` and
    /// `own_b`.
    bool both_frames = false;
    frame_map<D> own_a{};
    frame_map<D> own_b{};
};

}  // namespace detail

/// The search of two trees, cut into chunks that depend on the trees and their transforms alone.
///
/// The caller runs the chunks, usually with `for_chunks(search.chunks(), 1, ...)`, and keeps a
/// state of its own for each: chunks share nothing, and joining the states in order gives the same
/// result on any number of threads.
///
/// Boxes of trees with different frames or under a transform are compared in one frame, rounded
/// outward; each node is mapped when it is opened. The scales of the trees may differ by any
/// factor. Nodes that overlap no box of the other tree are skipped.
///
/// \source Sajovic, Knez and Korez, tf::tree, Algorithm 2; one box against eight at a time
template <std::size_t D>
class TREEFORM_API pair_search_chunks {
  public:
    /// Boxes of a moved tree count as overlapping if the axis-aligned boxes around them do. With
    /// `in_both_frames`, their boxes in the frame of the moved tree must overlap, too. For rotated
    /// surfaces, this omits about a quarter of the pairs, but none that meet. It has no effect
    /// unless exactly one of the trees is moved.
    ///
    /// \pre the trees outlive the search and are not rebuilt meanwhile
    pair_search_chunks(const transformed<D>& a, const transformed<D>& b,
                       bool in_both_frames = false);

    [[nodiscard]] std::size_t chunks() const;

    /// Calls `visit` for the blocks of one chunk, in order, until it returns false. All chunks
    /// together have every pair of primitives whose boxes overlap (touching counts) exactly once,
    /// and some whose boxes miss by less than the rounding of the float boxes and, under a
    /// transform, of the boxes around rotated boxes. An empty tree has no pairs.
    ///
    /// \cost over all chunks O(pairs of overlapping nodes + P) for P candidates
    search_statistics visit(std::size_t chunk,
                            detail::function_ref<bool(const candidate_block&)> visit) const;

    /// The candidates of all chunks on this thread, in smaller blocks and without the cost of
    /// splitting the search: for searches that are likely to stop early.
    static search_statistics visit_all(const transformed<D>& a, const transformed<D>& b,
                                       detail::function_ref<bool(const candidate_block&)> visit,
                                       bool in_both_frames = false);

  private:
    detail::two_trees<D> trees_;
    unsigned height_a_ = 0;  ///< height above the leaf blocks of the nodes in `items_`
    unsigned height_b_ = 0;
    std::vector<detail::node_pair> items_;
};

namespace detail {

template <std::size_t D>
[[nodiscard]] auto pairs_of(const transformed<D>& a, const transformed<D>& b) {
    return pairs_of_tree(pair_search_chunks<D>(a, b), a.original().ids().data(),
                         b.original().ids().data());
}

/// The pairs of parts, one of each tree, that may have pairs of primitives, ascending.
template <class SideA, class SideB>
[[nodiscard]] std::vector<id_pair> pairs_of_parts_of(const SideA& a, const SideB& b) {
    return all_pairs<false>(pairs_of(a.top(), b.top()), every_pair);
}

template <std::size_t D, class A, class B>
[[nodiscard]] auto pairs_of(const transformed<D, A>& first, const transformed<D, B>& second) {
    const trees_side<D, A> a(first);
    const trees_side<D, B> b(second);
    pairs_of_parts<pair_search_chunks<D>> pairs;
    const auto prepare = [&](std::uint32_t x, std::uint32_t y) {
        (void)a.part(x);
        (void)b.part(y);
    };
    const auto add = [&](std::uint32_t x, std::uint32_t y) {
        const transformed<D> in_a = a.part(x), in_b = b.part(y);
        pairs.add(pair_search_chunks<D>(in_a, in_b), in_a.original().ids().data(),
                  in_b.original().ids().data());
    };
    for_parts(pairs_of_parts_of(a, b), prepare, add);
    return pairs;
}

}  // namespace detail

/// Calls `apply(state, a, b)` for every pair of a primitive `a` of the first tree and `b` of the
/// second whose boxes overlap. `apply` is called from several threads; each chunk has its own
/// state, made by `State{}`. Returns the states, in an order that depends on the trees alone. If
/// `apply` returns true (it may also return nothing), the search stops: the state of that call is
/// the last one returned, and the states contain what a single thread would have found by then.
///
/// Either side may be `transformed{tree, map}`.
template <class State, any_tree_or_transformed A, any_tree_or_transformed B, class Apply>
[[nodiscard]] std::vector<State> search(const A& a, const B& b, const Apply& apply) {
    return detail::pair_states<State>(detail::pairs_of(transformed(a), transformed(b)), apply);
}

/// The same for two `tree`s, in blocks of candidates, `apply(state, block)`, to test several at
/// once. A block has positions in leaf order, not ids.
template <class State, tree_or_transformed A, tree_or_transformed B, class Apply>
[[nodiscard]] std::vector<State> search_broad(const A& a, const B& b, const Apply& apply) {
    return detail::search_states<State>(pair_search_chunks<A::dimensions>(a, b),
                                        [&](State& state, const candidate_block& block) {
                                            return detail::asks_to_stop(apply, state, block);
                                        });
}

namespace detail {

/// Whether `accept(block)` is true for some block of candidates of two `tree`s. `accept` is called
/// from several threads, until a block is accepted.
///
/// A block may be passed twice. The first few thousand candidates are tested on one thread before
/// the search is split, so that a collision that is easy to find costs little.
template <tree_or_transformed A, tree_or_transformed B, class Accept>
[[nodiscard]] bool search_any_broad(const A& a, const B& b, const Accept& accept,
                                    bool in_both_frames = false) {
    constexpr std::size_t serially = 4096;
    bool found = false;
    std::size_t seen = 0;
    pair_search_chunks<A::dimensions>::visit_all(
        a, b,
        [&](const candidate_block& block) {
            found = accept(block);
            seen += block.first.size();
            return !found && seen < serially;
        },
        in_both_frames);
    if (found || seen < serially) return found;
    return detail::search_for_any(pair_search_chunks<A::dimensions>(a, b, in_both_frames), accept);
}

}  // namespace detail

/// Whether `accept(a, b)` is true for some pair of primitives whose boxes overlap. `accept` is
/// called from several threads, and may be called twice for a pair.
template <any_tree_or_transformed A, any_tree_or_transformed B, class Accept>
[[nodiscard]] bool search_any(const A& first, const B& second, const Accept& accept) {
    if constexpr (tree_or_transformed<A> && tree_or_transformed<B>) {
        const transformed<A::dimensions> a(first), b(second);
        const std::uint32_t* const ids_a = a.original().ids().data();
        const std::uint32_t* const ids_b = b.original().ids().data();
        return detail::search_any_broad(a, b, [&](const candidate_block& block) {
            return detail::any_of_block<false>(block, ids_a, ids_b, accept);
        });
    } else {
        const detail::trees_side a{transformed(first)};
        const detail::trees_side b{transformed(second)};
        return detail::any_of_parts(detail::pairs_of_parts_of(a, b), accept,
                                    [&](auto x, auto y, const auto& accepted) {
                                        return search_any(a.part(x), b.part(y), accepted);
                                    });
    }
}

/// The pairs (a, b) of primitives whose boxes overlap and for which `accept(a, b)` is true,
/// ascending. `accept` is called from several threads.
template <any_tree_or_transformed A, any_tree_or_transformed B, class Accept>
[[nodiscard]] std::vector<id_pair> search_all(const A& a, const B& b, const Accept& accept) {
    return detail::all_pairs<false>(detail::pairs_of(transformed(a), transformed(b)), accept);
}

/// The pairs whose boxes, as stored in the trees, overlap.
template <any_tree_or_transformed A, any_tree_or_transformed B>
[[nodiscard]] std::vector<id_pair> search_all(const A& a, const B& b) {
    return search_all(a, b, detail::every_pair);
}

}  // namespace treeform
