#include <treeform/tree/detail/round_boxes.hpp>

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libtree/build/round_boxes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using doubles = hn::ScalableTag<double>;
using floats = hn::Rebind<float, doubles>;
using longs = hn::Rebind<std::uint64_t, doubles>;
using words = hn::Rebind<std::uint32_t, doubles>;

/// (x - origin) * scale, to about 2^-24, clamped to the range of float.
hn::VFromD<floats> to_float(hn::VFromD<doubles> x, double origin, double scale) {
    const doubles d;
    constexpr double limit = std::numeric_limits<float>::max();
    const auto y = hn::Mul(hn::Sub(x, hn::Set(d, origin)), hn::Set(d, scale));
    return hn::DemoteTo(floats(), hn::Min(hn::Max(y, hn::Set(d, -limit)), hn::Set(d, limit)));
}

/// What makes center - half and center + half, rounded to float, lie outside the exact image of a
/// box with |lo|, |hi| <= m. With u = 2^-24:
/// - `to_float` is off by at most u |y| of the rounding to float and 2^-53 |y| of the difference,
///   for the exact value y: by less than 1.01 u m;
/// - hi - center <= 2 m is off by u times itself, adding the margin by u (2 m + margin), and the
///   final center + half by u (m + margin) beyond what a larger half gains: together by less than
///   5.01 u m + 2 u margin.
/// Seven units are 4.2e-7 m < 4.8e-7 m. Where m is so small that the product is flushed to 0, the
/// errors are below the least normal float, 1.2e-38. Scaling is exact except for underflow, which
/// that covers too. A clamped coordinate moves out to infinity: 4.8e-7 max is more than half an ulp
/// of max; inward it stays finite, which is right since x lies further out.
hn::VFromD<floats> margin(hn::VFromD<floats> m) {
    const floats f;
    return hn::Add(hn::Mul(m, hn::Set(f, 4.8e-7F)), hn::Set(f, 1e-37F));
}

/// Not empty, no NaN, no infinity.
auto is_sound(hn::VFromD<doubles> min, hn::VFromD<doubles> max) {
    const doubles d;
    constexpr double limit = std::numeric_limits<double>::max();
    return hn::And(hn::Le(min, max),
                   hn::And(hn::Ge(min, hn::Set(d, -limit)), hn::Le(max, hn::Set(d, limit))));
}

template <std::size_t D>
std::size_t round_lanes(const tree_frame<D>& frame, const box_block<D>& boxes, std::size_t count,
                        std::uint32_t first_id, split_record* records, half_extents* extents) {
    const doubles d;
    const floats f;
    const words w;
    const longs l;
    static_assert(sizeof(half_extents) == sizeof(std::uint64_t));
    const std::size_t lanes = hn::Lanes(d);
    for (std::size_t i = 0; i < count; i += lanes) {
        auto sound = hn::Eq(hn::Zero(d), hn::Zero(d));
        hn::VFromD<floats> center[3] = {hn::Zero(f), hn::Zero(f), hn::Zero(f)};
        auto packed = hn::Zero(l);
        for (std::size_t k = 0; k < D; ++k) {
            const auto min = hn::Load(d, boxes.min[k] + i), max = hn::Load(d, boxes.max[k] + i);
            sound = hn::And(sound, is_sound(min, max));
            const auto lo = to_float(min, frame.origin[k], frame.scale);
            const auto hi = to_float(max, frame.origin[k], frame.scale);
            const auto half = hn::Set(f, 0.5F);
            center[k] = hn::Add(hn::Mul(half, lo), hn::Mul(half, hi));
            const auto reach = hn::Add(hn::Max(hn::Sub(hi, center[k]), hn::Sub(center[k], lo)),
                                       margin(hn::Max(hn::Abs(lo), hn::Abs(hi))));
            // Adding to the bits of a float goes to the next larger one, from the greatest to
            // infinity.
            const auto up = hn::ShiftRight<half_extents::dropped>(
                hn::Add(hn::BitCast(w, reach), hn::Set(w, (1U << half_extents::dropped) - 1)));
            packed = hn::Or(hn::ShiftLeft<half_extents::kept>(packed), hn::PromoteTo(l, up));
        }
        const auto id = hn::BitCast(f, hn::Iota(w, first_id + static_cast<std::uint32_t>(i)));
        if (i + lanes <= count) {
            hn::StoreInterleaved4(center[0], center[1], center[2], id, f, records[i].center);
            hn::StoreU(packed, l, reinterpret_cast<std::uint64_t*>(extents + i));
        } else {
            split_record last_records[hn::MaxLanes(d)];
            half_extents last_extents[hn::MaxLanes(d)];
            hn::StoreInterleaved4(center[0], center[1], center[2], id, f, last_records[0].center);
            hn::StoreU(packed, l, reinterpret_cast<std::uint64_t*>(last_extents));
            std::copy_n(last_records, count - i, records + i);
            std::copy_n(last_extents, count - i, extents + i);
        }
        if (const auto unsound = hn::FindFirstTrue(d, hn::Not(sound)); unsound >= 0) {
            const std::size_t bad = i + static_cast<std::size_t>(unsound);
            if (bad < count) return bad;
        }
    }
    return count;
}

std::size_t round_2(const tree_frame<2>& frame, const box_block<2>& boxes, std::size_t count,
                    std::uint32_t first_id, split_record* records, half_extents* extents) {
    return round_lanes(frame, boxes, count, first_id, records, extents);
}
std::size_t round_3(const tree_frame<3>& frame, const box_block<3>& boxes, std::size_t count,
                    std::uint32_t first_id, split_record* records, half_extents* extents) {
    return round_lanes(frame, boxes, count, first_id, records, extents);
}

}  // namespace
}  // namespace treeform::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace treeform::detail {

HWY_EXPORT(round_2);
HWY_EXPORT(round_3);

template <std::size_t D>
std::size_t round_boxes(const tree_frame<D>& frame, const box_block<D>& boxes, std::size_t count,
                        std::uint32_t first_id, split_record* records, half_extents* extents) {
    if constexpr (D == 2)
        return HWY_DYNAMIC_DISPATCH(round_2)(frame, boxes, count, first_id, records, extents);
    else
        return HWY_DYNAMIC_DISPATCH(round_3)(frame, boxes, count, first_id, records, extents);
}

template std::size_t round_boxes(const tree_frame<2>&, const box_block<2>&, std::size_t,
                                 std::uint32_t, split_record*, half_extents*);
template std::size_t round_boxes(const tree_frame<3>&, const box_block<3>&, std::size_t,
                                 std::uint32_t, split_record*, half_extents*);

}  // namespace treeform::detail
#endif
