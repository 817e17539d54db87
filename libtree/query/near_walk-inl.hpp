/// \file
/// Traversal of a tree toward a query. Included once for each target of Highway.

#if defined(TREEFORM_NEAR_WALK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TREEFORM_NEAR_WALK_INL
#undef TREEFORM_NEAR_WALK_INL
#else
#define TREEFORM_NEAR_WALK_INL
#endif

#include <libtree/query/node_orders.hpp>
#include <treeform/tree/detail/near_query.hpp>
#include <treeform/tree/tree.hpp>

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Bit mask of the boxes of `node` that may contain something within `bound`, and the squared
/// distances of all boxes; for the guarantees see `near_bound`.
template <std::size_t D>
HWY_INLINE unsigned near_mask(const wide_node<D>& node, const std::array<float, D>& low,
                              const std::array<float, D>& high, float bound, float* squared) {
    const hn::CappedTag<float, 8> d;
    const std::size_t lanes = hn::Lanes(d);
    unsigned mask = 0;
    for (std::size_t i = 0; i < 8; i += lanes) {
        auto sum = hn::Zero(d);
        for (std::size_t k = 0; k < D; ++k) {
            const auto below = hn::Sub(hn::Load(d, node.min[k] + i), hn::Set(d, high[k]));
            const auto above = hn::Sub(hn::Set(d, low[k]), hn::Load(d, node.max[k] + i));
            const auto gap = hn::Max(hn::Max(below, above), hn::Zero(d));
            sum = hn::MulAdd(gap, gap, sum);
        }
        hn::Store(sum, d, squared + i);
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(d, hn::Le(sum, hn::Set(d, bound)), bits);
        mask |= (bits[0] & ((1U << lanes) - 1)) << i;
    }
    // Slots without a box are at infinite distance; so may be boxes far from the query.
    if (bound == std::numeric_limits<float>::infinity())
        for (unsigned i = 0; i < 8; ++i)
            if (!(node.min[0][i] <= node.max[0][i])) mask &= ~(1U << i);
    return mask;
}

/// Opens nodes in the order of `frontier` until none is left within `bound`. For leaf blocks it
/// calls `leaf(block, bound)`, which may lower the bound.
template <std::size_t D, class Frontier, class Leaf>
HWY_INLINE void walk_near(const tree<D>& t, const near_query<D>& query, float bound,
                          Frontier& frontier, const Leaf& leaf) {
    std::array<const wide_node<D>*, 12> level{};
    for (unsigned l = 0; l < t.levels(); ++l) level[l] = t.level(l).data();
    const unsigned last = t.levels() - 1;
    alignas(64) float squared[8];
    near_entry at{0.0F, 0, 0};
    do {
        if (at.level == last) {
            leaf(at.index, bound);
            continue;
        }
        const unsigned mask =
            near_mask(level[at.level][at.index], query.low, query.high, bound, squared);
        frontier.open();
        for (unsigned rest = mask; rest != 0; rest &= rest - 1) {
            const auto slot = static_cast<std::uint32_t>(std::countr_zero(rest));
            frontier.push({squared[slot], at.index * 8 + slot, at.level + 1});
        }
        frontier.close(t.child_count(at.level, at.index));
    } while (frontier.pop(at, bound));
}

/// Sorts the slots in `mask` by `squared`, ties by slot, into `slots`; returns their number.
HWY_INLINE std::size_t nearest_first(unsigned mask, const float* squared,
                                     std::array<std::uint8_t, 8>& slots) {
    std::size_t count = 0;
    for (; mask != 0; mask &= mask - 1) {
        const auto slot = static_cast<std::uint8_t>(std::countr_zero(mask));
        std::size_t at = count++;
        for (; at > 0 && squared[slot] < squared[slots[at - 1]]; --at) slots[at] = slots[at - 1];
        slots[at] = slot;
    }
    return count;
}

}  // namespace
}  // namespace treeform::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
