/// \file
/// Tests one box against the eight boxes of a node. Included once for each target of Highway.

#if defined(TREEFORM_OVERLAP_MASK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TREEFORM_OVERLAP_MASK_INL
#undef TREEFORM_OVERLAP_MASK_INL
#else
#define TREEFORM_OVERLAP_MASK_INL
#endif

#include <treeform/tree/tree.hpp>

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Bit mask of the boxes of `node` that overlap box `slot` of `other`. An empty slot overlaps
/// nothing, not even [-inf, inf]: its min, +inf, exceeds every max, which is clamped to the largest
/// float here, and no min of a box exceeds the largest float.
template <std::size_t D>
HWY_INLINE unsigned overlap_mask(const wide_node<D>& node, const wide_node<D>& other,
                                 std::size_t slot) {
    const hn::CappedTag<float, 8> d;
    const std::size_t lanes = hn::Lanes(d);
    const float max_0 = std::min(other.max[0][slot], std::numeric_limits<float>::max());
    unsigned mask = 0;
    for (std::size_t i = 0; i < 8; i += lanes) {
        auto overlap = hn::Le(hn::Load(d, node.min[0] + i), hn::Set(d, max_0));
        overlap =
            hn::And(overlap, hn::Ge(hn::Load(d, node.max[0] + i), hn::Set(d, other.min[0][slot])));
        for (std::size_t k = 1; k < D; ++k) {
            overlap = hn::And(overlap,
                              hn::Le(hn::Load(d, node.min[k] + i), hn::Set(d, other.max[k][slot])));
            overlap = hn::And(overlap,
                              hn::Ge(hn::Load(d, node.max[k] + i), hn::Set(d, other.min[k][slot])));
        }
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(d, overlap, bits);
        mask |= (bits[0] & ((1U << lanes) - 1)) << i;
    }
    return mask;
}

/// The same for each slot of `other` in `wanted`: clears the bits of `masks[slot]` that do not
/// overlap it. Returns the slots of `wanted` whose mask is not 0.
template <std::size_t D>
HWY_INLINE unsigned overlap_masks(const wide_node<D>& node, const wide_node<D>& other,
                                  unsigned wanted, unsigned* masks) {
    const hn::CappedTag<float, 8> d;
    const std::size_t lanes = hn::Lanes(d);
    for (std::size_t i = 0; i < 8; i += lanes) {
        hn::Vec<decltype(d)> min[D], max[D];
        for (std::size_t k = 0; k < D; ++k) {
            min[k] = hn::Load(d, node.min[k] + i);
            max[k] = hn::Load(d, node.max[k] + i);
        }
        const unsigned others = 0xFFU & ~(((1U << lanes) - 1) << i);
        for (unsigned rest = wanted; rest != 0; rest &= rest - 1) {
            const auto slot = static_cast<std::size_t>(std::countr_zero(rest));
            const float max_0 = std::min(other.max[0][slot], std::numeric_limits<float>::max());
            auto overlap = hn::Le(min[0], hn::Set(d, max_0));
            overlap = hn::And(overlap, hn::Ge(max[0], hn::Set(d, other.min[0][slot])));
            for (std::size_t k = 1; k < D; ++k) {
                overlap = hn::And(overlap, hn::Le(min[k], hn::Set(d, other.max[k][slot])));
                overlap = hn::And(overlap, hn::Ge(max[k], hn::Set(d, other.min[k][slot])));
            }
            std::uint8_t bits[8] = {};
            hn::StoreMaskBits(d, overlap, bits);
            masks[slot] &= others | ((bits[0] & ((1U << lanes) - 1)) << i);
        }
    }
    unsigned left = 0;
    for (unsigned rest = wanted; rest != 0; rest &= rest - 1)
        if (masks[std::countr_zero(rest)] != 0) left |= rest & (~rest + 1);
    return left;
}

}  // namespace
}  // namespace treeform::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
