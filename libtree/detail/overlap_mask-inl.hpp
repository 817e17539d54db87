/// \file
/// A box against the eight of a node. Included once for each target of Highway.

#if defined(TREEFORM_OVERLAP_MASK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TREEFORM_OVERLAP_MASK_INL
#undef TREEFORM_OVERLAP_MASK_INL
#else
#define TREEFORM_OVERLAP_MASK_INL
#endif

#include <libtree/tree.hpp>

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace tf::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Which boxes of `node` overlap box `slot` of `other`, a bit each. An empty slot overlaps nothing,
/// not even [-inf, inf]: its min, +inf, exceeds every max as it is taken here, and no min of a box
/// exceeds the largest float.
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

}  // namespace
}  // namespace tf::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
