#include <treeform/tree/detail/near_pair_walk.hpp>

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libtree/query/nearness_pair.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Behind the two, as they are compiled for each target.
#include <libtree/query/map_node-inl.hpp>
#include <libtree/query/near_walk-inl.hpp>

#ifndef TREEFORM_NEARNESS_PAIR_ONCE
#define TREEFORM_NEARNESS_PAIR_ONCE
namespace treeform::detail {

template <std::size_t D>
struct pair_walk<D>::context {
    const tree<D>& a;
    const tree<D>& b;
    const frame_map<D>& map_a;
    const frame_map<D>& map_b;
    const near_bound& bound_of;
    const raise_bounds* raise;  ///< may be null
};

namespace {

/// Pairs of nodes, the nearest on top. The heap moves only keys; places are used again, so that a
/// search stays in few cache lines.
template <std::size_t D>
class nearest_first_queue {
  public:
    void push(const pair_entry<D>& entry) {
        auto index = static_cast<std::uint32_t>(entries_.size());
        if (free_.empty()) {
            entries_.push_back(entry);
        } else {
            index = free_.back();
            free_.pop_back();
            entries_[index] = entry;
        }
        keys_.push_back({entry.lower, index});
        std::push_heap(keys_.begin(), keys_.end(), is_further());
    }
    [[nodiscard]] bool empty() const { return keys_.empty(); }
    pair_entry<D> pop() {
        std::pop_heap(keys_.begin(), keys_.end(), is_further());
        const std::uint32_t index = keys_.back().index;
        keys_.pop_back();
        free_.push_back(index);
        return entries_[index];
    }

  private:
    struct key {
        float lower;
        std::uint32_t index;
    };
    struct is_further {
        bool operator()(const key& x, const key& y) const {
            return x.lower != y.lower ? x.lower > y.lower : x.index > y.index;
        }
    };
    std::vector<key> keys_;
    std::vector<pair_entry<D>> entries_;
    std::vector<std::uint32_t> free_;
};

}  // namespace
}  // namespace treeform::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::HWY_NAMESPACE {
namespace {

/// Both are leaf blocks: nothing to open but their primitives.
template <std::size_t D>
HWY_INLINE bool is_last(const tree<D>& a, const tree<D>& b, const pair_entry<D>& at) {
    return a.is_leaf_level(at.a.level) && b.is_leaf_level(at.b.level);
}

template <std::size_t D>
HWY_INLINE float extent(const typename pair_entry<D>::side& of) {
    float most = 0.0F;
    for (std::size_t k = 0; k < D; ++k) most = std::max(most, of.high[k] - of.low[k]);
    return most;
}

/// The larger box is opened: eight tests in one, where all against all would be 64.
template <std::size_t D>
HWY_INLINE bool opens_a(const tree<D>& a, const tree<D>& b, const pair_entry<D>& at) {
    if (a.is_leaf_level(at.a.level)) return false;
    return b.is_leaf_level(at.b.level) || extent<D>(at.a) >= extent<D>(at.b);
}

/// A node in the common frame: itself, or its image in `space`.
template <std::size_t D>
HWY_INLINE const wide_node<D>& in_frame(const frame_map<D>& map, const wide_node<D>& node,
                                        wide_node<D>& space) {
    if (map.identity) return node;
    map_node(map, node, space);
    return space;
}

template <std::size_t D>
typename pair_entry<D>::side box_of(const wide_node<D>& node, std::size_t slot, std::uint32_t index,
                                    std::uint32_t level) {
    typename pair_entry<D>::side box{index, level, {}, {}};
    for (std::size_t k = 0; k < D; ++k) {
        box.low[k] = node.min[k][slot];
        box.high[k] = node.max[k][slot];
    }
    return box;
}

/// Opens one side of `at`, and adds the children that may be within `bound` to `below`.
template <std::size_t D>
void open(const tree<D>& t, const frame_map<D>& map, const raise_bounds* raise,
          const pair_entry<D>& at, typename pair_entry<D>::side pair_entry<D>::*opened,
          const typename pair_entry<D>::side& other, float bound,
          std::vector<pair_entry<D>>& below) {
    wide_node<D> space;
    alignas(64) float squared[8];
    const std::uint32_t level = (at.*opened).level;
    const std::uint32_t index = (at.*opened).index;
    const wide_node<D>& node = in_frame(map, t.level(level)[index], space);
    unsigned mask = near_mask(node, other.low, other.high, bound, squared);
    mask &= (1U << t.child_count(level, index)) - 1;
    if (raise != nullptr && !t.is_leaf_level(level)) {
        const bool of_a = opened == &pair_entry<D>::a;
        mask = (*raise)({of_a, level, index, other.level, other.index}, mask, bound, squared);
    }
    std::array<std::uint8_t, 8> slots;
    for (std::size_t i = nearest_first(mask, squared, slots); i-- > 0;) {
        pair_entry<D> child = at;
        child.lower = squared[slots[i]];
        child.*opened = box_of(node, slots[i], index * 8 + slots[i], level + 1);
        below.push_back(child);
    }
}

template <std::size_t D, class Context>
void open_larger(const Context& in, const pair_entry<D>& at, float bound,
                 std::vector<pair_entry<D>>& below) {
    if (opens_a(in.a, in.b, at))
        open(in.a, in.map_a, in.raise, at, &pair_entry<D>::a, at.b, bound, below);
    else
        open(in.b, in.map_b, in.raise, at, &pair_entry<D>::b, at.a, bound, below);
}

template <std::size_t D, class Context>
double visit_last(const Context& in, const pair_entry<D>& at, float bound, visit_blocks visit) {
    wide_node<D> space_a, space_b;
    const wide_node<D>& node_a = in_frame(in.map_a, in.a.level(at.a.level)[at.a.index], space_a);
    const wide_node<D>& node_b = in_frame(in.map_b, in.b.level(at.b.level)[at.b.index], space_b);
    alignas(64) float squared[8][8];
    alignas(64) float to_b[8];
    const unsigned in_use = (1U << in.a.child_count(at.a.level, at.a.index)) - 1;
    const unsigned present_b = (1U << in.b.child_count(at.b.level, at.b.index)) - 1;
    unsigned rows = near_mask(node_a, at.b.low, at.b.high, bound, to_b) & in_use;
    const unsigned near_rows = rows;
    for (; rows != 0; rows &= rows - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(rows));
        const auto box = box_of(node_a, i, 0, 0);
        (void)near_mask(node_b, box.low, box.high, bound, squared[i]);
    }
    return visit({at.a.index, at.b.index, squared, near_rows, present_b, in.bound_of});
}

/// The pair of the roots, in whole boxes.
template <std::size_t D, class Context>
pair_entry<D> roots_of(const Context& in) {
    const auto whole = [](const tree<D>& t, const frame_map<D>& map) {
        wide_node<D> space;
        const wide_node<D>& node = in_frame(map, t.level(0)[0], space);
        auto box = box_of(node, 0, 0, 0);
        for (std::size_t i = 1; i < t.child_count(0, 0); ++i)
            for (std::size_t k = 0; k < D; ++k) {
                box.low[k] = std::min(box.low[k], node.min[k][i]);
                box.high[k] = std::max(box.high[k], node.max[k][i]);
            }
        return box;
    };
    return {0.0F, whole(in.a, in.map_a), whole(in.b, in.map_b)};
}

/// Depth first until `stack` is empty.
template <std::size_t D, class Context>
void walk(const Context& in, std::vector<pair_entry<D>>& stack, const std::atomic<double>& shared,
          function_ref<bool()> stop, visit_blocks visit) {
    double limit = shared.load();
    float bound = in.bound_of(limit);
    while (!stack.empty()) {
        const pair_entry<D> at = stack.back();
        stack.pop_back();
        if (shared.load(std::memory_order_relaxed) < limit) {
            limit = shared.load(std::memory_order_relaxed);
            bound = in.bound_of(limit);
        }
        if (!(at.lower <= bound)) continue;
        if (!is_last(in.a, in.b, at)) {
            open_larger(in, at, bound, stack);
            continue;
        }
        limit = std::min(limit, visit_last(in, at, bound, visit));
        bound = in.bound_of(limit);
        if (stop()) return;
    }
}

/// Straight down to a first pair of leaf blocks, for a first bound; then best first, which opens
/// the fewest nodes and is soon near the final bound. Leaves what is left in `items`.
template <std::size_t D, class Context>
void walk_best_first(const Context& in, double squared, std::size_t budget,
                     function_ref<bool()> stop, visit_blocks visit,
                     std::vector<pair_entry<D>>& items) {
    float bound = in.bound_of(squared);
    nearest_first_queue<D> queue;
    std::vector<pair_entry<D>> below;
    const auto look_at = [&](const pair_entry<D>& at) {
        if (is_last(in.a, in.b, at))
            bound = std::min(bound, in.bound_of(visit_last(in, at, bound, visit)));
        else
            open_larger(in, at, bound, below);
    };
    for (below = {roots_of<D>(in)}; !below.empty();) {
        const pair_entry<D> nearest = below.back();
        below.pop_back();
        for (const pair_entry<D>& other : below) queue.push(other);
        below.clear();
        look_at(nearest);
    }
    for (; !queue.empty() && budget != 0 && !stop(); --budget) {
        const pair_entry<D> at = queue.pop();
        if (!(at.lower <= bound)) return;
        look_at(at);
        for (const pair_entry<D>& child : below) queue.push(child);
        below.clear();
    }
    while (!queue.empty() && !stop()) items.push_back(queue.pop());
}

template <std::size_t D, class Context>
void begin_walk(const Context& in, double squared, function_ref<bool()> stop, visit_blocks visit,
                std::vector<pair_entry<D>>& items) {
    // Where more is known than boxes, most searches end within this, having opened hardly a node
    // too many. Boxes alone leave so many pairs about as near that keeping them in order costs more
    // than it spares, beyond a bound near the final one; the rest goes depth first, which stays
    // near in memory, in a few large pieces.
    const std::size_t budget = in.raise != nullptr ? 1024 : 256;
    constexpr std::size_t enough = 64;
    double limit = squared;
    items.clear();
    walk_best_first(
        in, squared, budget, stop, [&](const block_pair& blocks) { return limit = visit(blocks); },
        items);
    const float bound = in.bound_of(limit);
    bool opened = true;
    while (opened && items.size() < enough) {
        opened = false;
        std::vector<pair_entry<D>> below;
        for (const pair_entry<D>& at : items) {
            if (!(at.lower <= bound)) continue;
            if (is_last(in.a, in.b, at)) {
                below.push_back(at);
            } else {
                open_larger(in, at, bound, below);
                opened = true;
            }
        }
        items = std::move(below);
    }
    std::stable_sort(items.begin(), items.end(),
                     [](const auto& x, const auto& y) { return x.lower < y.lower; });
}

template <std::size_t D, class Context>
void visit_items(const Context& in, const pair_entry<D>* first, const pair_entry<D>* last,
                 const std::atomic<double>& shared, function_ref<bool()> stop, visit_blocks visit) {
    std::vector<pair_entry<D>> stack;
    stack.reserve(192);
    for (; first != last && !stop(); ++first) {
        stack.assign(1, *first);
        walk(in, stack, shared, stop, visit);
    }
}

void begin_2(const pair_walk<2>::context& in, double squared, function_ref<bool()> stop,
             visit_blocks visit, std::vector<pair_entry<2>>& items) {
    begin_walk(in, squared, stop, visit, items);
}
void begin_3(const pair_walk<3>::context& in, double squared, function_ref<bool()> stop,
             visit_blocks visit, std::vector<pair_entry<3>>& items) {
    begin_walk(in, squared, stop, visit, items);
}
void visit_2(const pair_walk<2>::context& in, const pair_entry<2>* first, const pair_entry<2>* last,
             const std::atomic<double>& shared, function_ref<bool()> stop, visit_blocks visit) {
    visit_items(in, first, last, shared, stop, visit);
}
void visit_3(const pair_walk<3>::context& in, const pair_entry<3>* first, const pair_entry<3>* last,
             const std::atomic<double>& shared, function_ref<bool()> stop, visit_blocks visit) {
    visit_items(in, first, last, shared, stop, visit);
}

}  // namespace
}  // namespace treeform::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace treeform::detail {
namespace {

HWY_EXPORT(begin_2);
HWY_EXPORT(begin_3);
HWY_EXPORT(visit_2);
HWY_EXPORT(visit_3);

}  // namespace

template <std::size_t D>
pair_walk<D>::pair_walk(const transformed<D>& a, const transformed<D>& b, double unit)
    : a_(&a.original()), b_(&b.original()), bound_of_(1.0) {
    const tree_frame<D> frame = common_frame(a_->frame(), a.map(), b_->frame(), b.map());
    map_a_ = map_into(a_->frame(), a.map(), frame);
    map_b_ = map_into(b_->frame(), b.map(), frame);
    bound_of_ = near_bound(frame.scale, unit);
}

template <std::size_t D>
typename pair_walk<D>::context pair_walk<D>::trees() const {
    return {*a_, *b_, map_a_, map_b_, bound_of_, raise_};
}

template <std::size_t D>
void pair_walk<D>::begin(double squared, function_ref<bool()> stop, visit_blocks visit) {
    if (a_->empty() || b_->empty()) return;
    if constexpr (D == 2)
        HWY_DYNAMIC_DISPATCH(begin_2)(trees(), squared, stop, visit, items_);
    else
        HWY_DYNAMIC_DISPATCH(begin_3)(trees(), squared, stop, visit, items_);
}

template <std::size_t D>
void pair_walk<D>::visit(std::size_t chunk, const std::atomic<double>& shared,
                         function_ref<bool()> stop, visit_blocks visit) const {
    const pair_entry<D>* const first = items_.data() + chunk * grain;
    const pair_entry<D>* const last = items_.data() + std::min((chunk + 1) * grain, items_.size());
    if constexpr (D == 2)
        HWY_DYNAMIC_DISPATCH(visit_2)(trees(), first, last, shared, stop, visit);
    else
        HWY_DYNAMIC_DISPATCH(visit_3)(trees(), first, last, shared, stop, visit);
}

template class pair_walk<2>;
template class pair_walk<3>;

}  // namespace treeform::detail
#endif
