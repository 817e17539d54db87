#pragma once
/// \file
/// The walk through two trees toward their nearest pairs, cut into chunks for many threads.

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

/// Two leaf blocks, and how far apart the boxes of their primitives are.
struct block_pair {
    std::uint32_t a;
    std::uint32_t b;
    const float (&squared)[8][8];  ///< of those present, as `near_bound` takes it
    unsigned present_a;            ///< slots with a primitive that may be near, a bit each
    unsigned present_b;
    const near_bound& bound_of;

    /// Whether slot i of a and slot j of b may be within `bound`, what `bound_of` says of a limit.
    [[nodiscard]] bool within(std::size_t i, std::size_t j, float bound) const {
        return (present_a >> i & present_b >> j & 1U) != 0 && squared[i][j] <= bound;
    }
};

/// A pair of nodes that may hold near pairs; boxes in the common frame.
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

/// A node that is opened, and the node of the other tree that its children are held against.
struct opened_node {
    bool of_a;  ///< the one opened
    std::uint32_t level;
    std::uint32_t index;
    std::uint32_t other_level;
    std::uint32_t other_index;
};

/// What a caller knows of nodes beyond their boxes: raises the squared distances in `squared` of
/// the children in `mask` from the other node, as far as it can, and returns those of the mask
/// that are within `bound` still. What `near_bound` asks of a distance of boxes holds for these.
using raise_bounds =
    function_ref<unsigned(const opened_node&, unsigned mask, float bound, float* squared)>;

/// What a visitor returns: the squared distance beyond which it wants no pair; it may only fall.
using visit_blocks = function_ref<double(const block_pair&)>;

template <std::size_t D>
class TREEFORM_API pair_walk {
  public:
    /// Squared distances will be those of coordinates times `unit`, a power of two.
    pair_walk(const transformed<D>& a, const transformed<D>& b, double unit);

    /// Walks best first for a while: to the end when that is near. Then cuts what is left into
    /// pairs of nodes, the nearest first, to be searched depth first. `stop` says, after each
    /// visit, when nothing is of interest any more.
    void begin(double squared, function_ref<bool()> stop, visit_blocks visit);

    [[nodiscard]] std::size_t chunks() const { return chunk_count(items_.size(), grain); }
    /// Visits what is left in a chunk. The limit that `visit` returns is joined with `shared`,
    /// which others may lower meanwhile; `stop` says when the rest is of no interest.
    void visit(std::size_t chunk, const std::atomic<double>& shared, function_ref<bool()> stop,
               visit_blocks visit) const;

    /// How coordinates of the trees come into the common frame.
    [[nodiscard]] const frame_map<D>& map_a() const { return map_a_; }
    [[nodiscard]] const frame_map<D>& map_b() const { return map_b_; }
    /// From now on children that are nodes are held against `raise` as well; it outlives the walk.
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

/// Runs `walk` on the threads at hand. `all` is what is kept, and has a `bound()`, a squared
/// distance, and a `done()`, when zero is reached; `visit(blocks, kept, limit)` fills it;
/// `fork(all)` makes an empty one with its bound for each chunk, and `join(all, part)` joins these
/// in order.
///
/// The result depends on no timing: pairs are skipped only when strictly further than the bound of
/// some chunk, which is never below the final one, so whatever belongs to the result is found. The
/// order within a chunk is fixed. A chunk that is `done()`, at zero, ends itself and later ones
/// only, and these are not joined.
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
