#include <libmesh/intersect/block_planes.hpp>

#include <cstddef>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libmesh/intersect/block_planes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::intersect::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using lanes_tag = hn::CappedTag<double, 8>;
using vec = hn::Vec<lanes_tag>;

struct vec3 {
    vec of[3];
};

HWY_INLINE vec3 load(const double (&corner)[3][8], std::size_t i) {
    const lanes_tag d;
    return {{hn::Load(d, corner[0] + i), hn::Load(d, corner[1] + i), hn::Load(d, corner[2] + i)}};
}

HWY_INLINE vec3 minus(const vec3& a, const vec3& b) {
    return {{hn::Sub(a.of[0], b.of[0]), hn::Sub(a.of[1], b.of[1]), hn::Sub(a.of[2], b.of[2])}};
}

/// Not fused, so that every machine drops the same pairs.
HWY_INLINE vec dot(const vec3& a, const vec3& b) {
    return hn::Add(hn::Add(hn::Mul(a.of[0], b.of[0]), hn::Mul(a.of[1], b.of[1])),
                   hn::Mul(a.of[2], b.of[2]));
}

void find_eight(const nearness::eight_triangles& from, const point3& origin, block_planes& to) {
    const lanes_tag d;
    const vec3 center{{hn::Set(d, origin.x), hn::Set(d, origin.y), hn::Set(d, origin.z)}};
    vec reach = hn::Zero(d);
    for (std::size_t i = 0; i < 8; i += hn::Lanes(d)) {
        const vec3 p[3] = {load(from.at[0], i), load(from.at[1], i), load(from.at[2], i)};
        vec3 first;
        for (std::size_t corner = 3; corner-- > 0;) {
            first = minus(p[corner], center);
            for (std::size_t k = 0; k < 3; ++k) {
                hn::Store(first.of[k], d, to.at[corner][k] + i);
                reach = hn::Add(reach, hn::Abs(first.of[k]));
            }
        }
        const vec3 u = minus(p[1], p[0]), v = minus(p[2], p[0]);
        vec3 normal;
        vec spread = hn::Zero(d);
        for (std::size_t k = 0; k < 3; ++k) {
            const vec ahead = hn::Mul(u.of[(k + 1) % 3], v.of[(k + 2) % 3]);
            const vec behind = hn::Mul(u.of[(k + 2) % 3], v.of[(k + 1) % 3]);
            normal.of[k] = hn::Sub(ahead, behind);
            spread = hn::Add(spread, hn::Add(hn::Abs(ahead), hn::Abs(behind)));
            hn::Store(normal.of[k], d, to.normal[k] + i);
        }
        hn::Store(dot(normal, first), d, to.offset + i);
        hn::Store(spread, d, to.spread + i);
    }
    to.reach = hn::GetLane(hn::SumOfLanes(d, reach));
}

/// What lies above `high` or below `low` is beyond a plane.
struct plane_bounds {
    alignas(64) double low[8], high[8];
};

/// A product n . p of a normal and a corner about the origin is held against n . q of a corner q of
/// the plane. Let u = 2^-52, S the spread and R the reach of both blocks, which no coordinate
/// exceeds. A component of n has four roundings for each of its two products, p has one and the
/// product and the sums have three: n . p and n . q are off by less than 8.1 u S R each, and the
/// sum of n . q and the margin by less than 1.1 u S R. The margin is 2^-46 S R = 64 u S R.
///
/// Underflow: each of less than 2^6 operations may lose 2^-1020, which is multiplied by at most
/// (2.1 R)^2; with R <= 2^100 all that is below 2^-800. Overflow: S R < 2^310.
HWY_INLINE plane_bounds bounds_of(const block_planes& planes, double reach) {
    const lanes_tag d;
    plane_bounds bounds;
    for (std::size_t i = 0; i < 8; i += hn::Lanes(d)) {
        const vec margin =
            hn::Add(hn::Mul(hn::Mul(hn::Set(d, 0x1p-46), hn::Load(d, planes.spread + i)),
                            hn::Set(d, reach)),
                    hn::Set(d, 0x1p-800));
        const vec offset = hn::Load(d, planes.offset + i);
        hn::Store(hn::Sub(offset, margin), d, bounds.low + i);
        hn::Store(hn::Add(offset, margin), d, bounds.high + i);
    }
    return bounds;
}

HWY_INLINE unsigned beyond(vec s0, vec s1, vec s2, vec low, vec high) {
    const lanes_tag d;
    const vec least = hn::Min(hn::Min(s0, s1), s2);
    const vec most = hn::Max(hn::Max(s0, s1), s2);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Or(hn::Gt(least, high), hn::Lt(most, low)), bits);
    return bits[0];
}

HWY_INLINE vec3 broadcast(const double (&corner)[3][8], std::size_t slot) {
    const lanes_tag d;
    return {
        {hn::Set(d, corner[0][slot]), hn::Set(d, corner[1][slot]), hn::Set(d, corner[2][slot])}};
}

void drop_eight(const block_planes& a, const block_planes& b, nearness::slot_pairs& pairs) {
    const lanes_tag d;
    const double reach = a.reach + b.reach;
    if (!(reach <= 0x1p100)) return;  // nothing is dropped for NaN
    const plane_bounds of_a = bounds_of(a, reach);
    const plane_bounds of_b = bounds_of(b, reach);
    const std::size_t lanes = hn::Lanes(d);
    for (std::size_t j = 0; j < 8; j += lanes) {
        const unsigned in_use = ((1U << lanes) - 1) << j;
        const vec3 normal = load(b.normal, j);
        const vec low = hn::Load(d, of_b.low + j), high = hn::Load(d, of_b.high + j);
        const vec3 corners[3] = {load(b.at[0], j), load(b.at[1], j), load(b.at[2], j)};
        for (std::size_t i = 0; i < 8; ++i) {
            if ((pairs[i] & in_use) == 0) continue;
            pairs[i] &=
                ~(beyond(dot(normal, broadcast(a.at[0], i)), dot(normal, broadcast(a.at[1], i)),
                         dot(normal, broadcast(a.at[2], i)), low, high)
                      << j &
                  in_use);
            if ((pairs[i] & in_use) == 0) continue;
            const vec3 normal_of_a = broadcast(a.normal, i);
            pairs[i] &= ~(beyond(dot(normal_of_a, corners[0]), dot(normal_of_a, corners[1]),
                                 dot(normal_of_a, corners[2]), hn::Set(d, of_a.low[i]),
                                 hn::Set(d, of_a.high[i]))
                              << j &
                          in_use);
        }
    }
}

}  // namespace
}  // namespace treeform::detail::intersect::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace treeform::detail::intersect {
namespace {

HWY_EXPORT(find_eight);
HWY_EXPORT(drop_eight);

}  // namespace

void find_planes(const nearness::eight_triangles& from, const point3& origin, block_planes& to) {
    HWY_DYNAMIC_DISPATCH(find_eight)(from, origin, to);
}

void drop_beyond_planes(const block_planes& a, const block_planes& b, nearness::slot_pairs& pairs) {
    HWY_DYNAMIC_DISPATCH(drop_eight)(a, b, pairs);
}

}  // namespace treeform::detail::intersect
#endif
