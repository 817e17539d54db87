/// \file
/// Maps the eight boxes of a node into another frame. Included once for each target of Highway.

#if defined(TREEFORM_MAP_NODE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TREEFORM_MAP_NODE_INL
#undef TREEFORM_MAP_NODE_INL
#else
#define TREEFORM_MAP_NODE_INL
#endif

#include <treeform/tree/detail/frame_map.hpp>
#include <treeform/tree/tree.hpp>

#include <hwy/highway.h>

#include <cstddef>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Maps boxes i ... i + lanes - 1 of `from` into `to`; see `frame_map` for the arithmetic and its
/// bound. Empty slots stay empty.
template <std::size_t D, bool Diagonal>
HWY_INLINE void map_lanes(const frame_map<D>& map, const wide_node<D>& from, wide_node<D>& to,
                          std::size_t i) {
    const hn::CappedTag<float, 8> d;
    using lanes = hn::Vec<decltype(d)>;
    const lanes infinity = hn::Set(d, std::numeric_limits<float>::infinity());
    const lanes minus_infinity = hn::Neg(infinity);
    const lanes largest = hn::Set(d, std::numeric_limits<float>::max());
    const lanes limit = hn::Set(d, map.limit);
    const auto in_use = hn::Le(hn::Load(d, from.min[0] + i), hn::Load(d, from.max[0] + i));
    lanes min[D], max[D], reach[D];  // all loads precede the stores
    for (std::size_t j = 0; j < D; ++j) {
        min[j] = hn::Min(hn::Load(d, from.min[j] + i), limit);
        max[j] = hn::Max(hn::Load(d, from.max[j] + i), hn::Neg(limit));
        reach[j] = hn::Max(hn::Abs(min[j]), hn::Abs(max[j]));
    }
    for (std::size_t k = 0; k < D; ++k) {
        lanes low = hn::Set(d, map.offset[k]);
        lanes high = low;
        lanes slack = hn::Set(d, map.slack_offset[k]);
        for (std::size_t j = Diagonal ? k : 0; j < (Diagonal ? k + 1 : D); ++j) {
            // Interval arithmetic for a factor of any sign. Not fused, so that candidates are the
            // same on every machine.
            const lanes factor = hn::Set(d, map.linear[k][j]);
            const lanes from_min = hn::Mul(factor, min[j]);
            const lanes from_max = hn::Mul(factor, max[j]);
            low = hn::Add(hn::Min(from_min, from_max), low);
            high = hn::Add(hn::Max(from_min, from_max), high);
            slack = hn::Add(hn::Mul(hn::Set(d, map.slack[k][j]), reach[j]), slack);
        }
        low = hn::Sub(low, slack);
        high = hn::Add(high, slack);
        // NaN, from infinity minus infinity, gives an infinite side. A side clamped inward stays
        // finite.
        low = hn::IfThenElse(hn::Eq(low, low), hn::Min(low, largest), minus_infinity);
        high = hn::IfThenElse(hn::Eq(high, high), hn::Max(high, hn::Neg(largest)), infinity);
        hn::Store(hn::IfThenElse(in_use, low, infinity), d, to.min[k] + i);
        hn::Store(hn::IfThenElse(in_use, high, minus_infinity), d, to.max[k] + i);
    }
}

template <std::size_t D>
HWY_INLINE void map_node(const frame_map<D>& map, const wide_node<D>& from, wide_node<D>& to) {
    for (std::size_t i = 0; i < 8; i += hn::Lanes(hn::CappedTag<float, 8>()))
        if (map.diagonal)
            map_lanes<D, true>(map, from, to, i);
        else
            map_lanes<D, false>(map, from, to, i);
}

}  // namespace
}  // namespace treeform::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
