#pragma once
/// \file
/// Traversal of two trees toward their nearest pairs, in chunks for parallel execution.

#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/detail/frame_map.hpp>
#include <treeform/tree/detail/function_ref.hpp>
#include <treeform/tree/detail/near_query.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/tree.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail {

/// Two leaf blocks, and the distances of the boxes of their primitives.
struct block_pair {
    std::uint32_t a;
    std::uint32_t b;
    /// squared distances of present slots, comparable with `near_bound`
    const float (&squared)[8][8];
    unsigned present_a;  ///< bit mask of the slots with a primitive that may be near
    unsigned present_b;
    const near_bound& bound_of;

    /// Whether slot i of a and slot j of b may be within `bound`, a result of `bound_of`.
    [[nodiscard]] bool within(std::size_t i, std::size_t j, float bound) const {
        return (present_a >> i & present_b >> j & 1U) != 0 && squared[i][j] <= bound;
    }
};

/// A pair of nodes that may contain near pairs; boxes in the common frame.
template <std::size_t D>
struct pair_entry {
    struct side {
        std::uint32_t index;
        std::uint32_t level;
        std::array<float, D> low;
        std::array<float, D> high;
    };
    float lower;
    side a;
    side b;
};

/// A node that is opened, and the node of the other tree with which its children are compared.
struct opened_node {
    bool of_a;  ///< whether the opened node is of tree a
    std::uint32_t level;
    std::uint32_t index;
    std::uint32_t other_level;
    std::uint32_t other_index;
};

/// Tighter bounds that a caller has for nodes, beyond their boxes: raises the squared distances in
/// `squared` of the children in `mask` from the other node where it can, and returns the mask of
/// those that are still within `bound`. The raised values must satisfy the same guarantees as box
/// distances; see `near_bound`.
using raise_bounds =
    function_ref<unsigned(const opened_node&, unsigned mask, float bound, float* squared)>;

/// A visitor of pairs of leaf blocks. It returns the squared distance beyond which it needs no
/// pairs; this must not increase.
using visit_blocks = function_ref<double(const block_pair&)>;

template <std::size_t D>
class TREEFORM_API pair_walk {
  public:
    /// Squared distances are those of coordinates times `unit`, a power of two.
    pair_walk(const transformed<D>& a, const transformed<D>& b, double unit);

    /// Traverses best first for a limited number of steps; small searches end here. Then cuts the
    /// rest into pairs of nodes, the nearest first, which `visit` searches depth first. `stop` is
    /// called after each visit; if it returns true, the search ends.
    void begin(double squared, function_ref<bool()> stop, visit_blocks visit);

    [[nodiscard]] std::size_t chunks() const { return chunk_count(items_.size(), grain); }
    /// Visits the pairs of a chunk. The limit is the lesser of what `visit` returned and `shared`,
    /// which other threads may lower meanwhile. If `stop` returns true, the rest of the chunk is
    /// skipped.
    void visit(std::size_t chunk, const std::atomic<double>& shared, function_ref<bool()> stop,
               visit_blocks visit) const;

    /// The maps of the trees' boxes into the common frame.
    [[nodiscard]] const frame_map<D>& map_a() const { return map_a_; }
    [[nodiscard]] const frame_map<D>& map_b() const { return map_b_; }
    /// From now on, also uses `raise`, which must outlive the walk, for children that are nodes.
    void raise_by(const raise_bounds& raise) { raise_ = &raise; }

    struct context;

  private:
    static constexpr std::size_t grain = 1;
    [[nodiscard]] context trees() const;

    const tree<D>* a_;
    const tree<D>* b_;
    frame_map<D> map_a_;
    frame_map<D> map_b_;
    near_bound bound_of_;
    const raise_bounds* raise_ = nullptr;
    std::vector<pair_entry<D>> items_;
};

extern template class pair_walk<2>;
extern template class pair_walk<3>;

/// Runs `walk` in parallel, and returns the pairs kept. `all` has a `bound()`, a squared distance,
/// and a `done()`, true once the bound is zero. `visit(blocks, kept, limit)` adds pairs to it;
/// `fork(all)` makes an empty one with the same bound for each chunk; `join(all, part)` merges
/// these in order.
///
/// The result does not depend on timing: pairs are skipped only if they are strictly further than
/// the bound of some chunk, which is never below the final bound, so all pairs of the result are
/// found. The order within a chunk is fixed. A chunk that is `done()` ends only itself and later
/// chunks, which are not joined.
template <std::size_t D, class Kept, class Visit, class Fork, class Join>
[[nodiscard]] Kept walk_pairs(pair_walk<D>& walk, Kept all, const Visit& visit, const Fork& fork,
                              const Join& join) {
    const double first_bound = all.bound();
    const auto visit_first = [&](const block_pair& blocks) {
        visit(blocks, all, first_bound);
        return all.bound();
    };
    walk.begin(
        first_bound, [&] { return all.done(); }, visit_first);
    if (walk.chunks() == 0 || all.done()) return all;

    std::atomic<double> shared{all.bound()};
    std::atomic<std::size_t> last{walk.chunks() - 1};  // the first chunk that was done
    std::vector<Kept> parts(walk.chunks(), fork(all));
    for_chunks(walk.chunks(), 1, [&](std::size_t chunk, std::size_t, std::size_t) {
        Kept& mine = parts[chunk];
        const auto stop = [&] {
            return mine.done() || chunk > last.load(std::memory_order_relaxed);
        };
        walk.visit(chunk, shared, stop, [&](const block_pair& blocks) {
            visit(blocks, mine, shared.load(std::memory_order_relaxed));
            double seen = shared.load();
            while (mine.bound() < seen && !shared.compare_exchange_weak(seen, mine.bound())) {
            }
            if (mine.done()) {
                std::size_t first = last.load();
                while (chunk < first && !last.compare_exchange_weak(first, chunk)) {
                }
            }
            return mine.bound();
        });
    });
    for (std::size_t chunk = 0; chunk <= last.load(); ++chunk) join(all, parts[chunk]);
    return all;
}

}  // namespace treeform::detail
