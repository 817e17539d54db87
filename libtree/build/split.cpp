#include <treeform/tree/detail/split.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libtree/build/split.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Smallest and largest of each of the four words of a record; the id rides along, unused.
void word_ranges(const split_record* records, std::size_t count, float* lo, float* hi) {
#if HWY_TARGET == HWY_SCALAR
    for (int k = 0; k < 3; ++k) lo[k] = hi[k] = records[0].center[k];
    for (std::size_t i = 1; i < count; ++i)
        for (int k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], records[i].center[k]);
            hi[k] = std::max(hi[k], records[i].center[k]);
        }
#else
    const hn::FixedTag<float, 4> d;
    auto min0 = hn::LoadU(d, records[0].center), max0 = min0;
    auto min1 = min0, max1 = max0;  // two chains, since one waits for its own last result
    std::size_t i = 1;
    for (; i + 1 < count; i += 2) {
        const auto a = hn::LoadU(d, records[i].center);
        const auto b = hn::LoadU(d, records[i + 1].center);
        min0 = hn::Min(min0, a);
        max0 = hn::Max(max0, a);
        min1 = hn::Min(min1, b);
        max1 = hn::Max(max1, b);
    }
    if (i < count) {
        const auto a = hn::LoadU(d, records[i].center);
        min0 = hn::Min(min0, a);
        max0 = hn::Max(max0, a);
    }
    hn::StoreU(hn::Min(min0, min1), d, lo);
    hn::StoreU(hn::Max(max0, max1), d, hi);
#endif
}

center_range range_of_records(const split_record* records, std::size_t count) {
    float lo[4], hi[4];
    word_ranges(records, count, lo, hi);
    return {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}};
}

/// rank[i] = number of keys less than keys[i]. Both arrays are padded to whole vectors; all keys
/// differ and the padding is not less than any.
template <class Key>
void rank_by_counting(const Key* keys, std::size_t count, Key* rank) {
    const hn::CappedTag<Key, 32 / sizeof(Key)> d;
    const std::size_t lanes = hn::Lanes(d);
    for (std::size_t i = 0; i < count; i += 2 * lanes) {
        const auto key0 = hn::Load(d, keys + i);
        const auto key1 = hn::Load(d, keys + i + lanes);
        auto less0 = hn::Zero(d);
        auto less1 = hn::Zero(d);
        for (std::size_t j = 0; j < count; ++j) {
            const auto other = hn::Set(d, keys[j]);
            less0 = hn::Sub(less0, hn::VecFromMask(d, hn::Lt(other, key0)));
            less1 = hn::Sub(less1, hn::VecFromMask(d, hn::Lt(other, key1)));
        }
        hn::Store(less0, d, rank + i);
        hn::Store(less1, d, rank + i + lanes);
    }
}

constexpr std::size_t max_ranked = 64;
constexpr std::size_t padding = 32;  // two vectors of 16-bit keys

/// Splits up to `max_ranked` records by sorting them on ten bits of their key within the range of
/// the axis; the position in `from` fills the low six bits, so that no two keys are equal. Records
/// less than a thousandth of the range apart may so end up on the wrong side of the cut; their
/// boxes hold them wherever they are.
void split_by_rank(const split_record* from, split_record* to, std::size_t count,
                   const split_axis& axis) {
    alignas(64) std::int16_t keys[max_ranked + padding];
    alignas(64) std::int16_t rank[max_ranked + padding];
    // Halved, so that the range of two extreme floats is finite.
    const float base = 0.5F * axis.min;
    const float range = 0.5F * axis.max - base;
    const float scale = range > 1e-30F ? 1023.0F / range : 0.0F;
    for (std::size_t i = 0; i < count; ++i) {
        const float place = (0.5F * from[i].center[axis.axis] - base) * scale;
        const auto cell = static_cast<std::int32_t>(std::min(std::max(place, 0.0F), 1023.0F));
        keys[i] = static_cast<std::int16_t>(cell * 64 + static_cast<std::int32_t>(i) - 32768);
    }
    std::fill_n(keys + count, padding, std::numeric_limits<std::int16_t>::max());
    rank_by_counting(keys, count, rank);
    for (std::size_t i = 0; i < count; ++i) to[rank[i]] = from[i];
}

/// Records at equal distances, which stand for all of a large set. Where they lie decides how good
/// a split is, never whether it is right.
struct record_sample {
    static constexpr std::size_t max_size = 128;
    std::array<split_record, max_size> records;
    std::size_t size;

    record_sample(const split_record* from, std::size_t count)
        : size(count <= 256    ? 32
               : count <= 4096 ? 64
                               : 128) {
        for (std::size_t i = 0; i < size; ++i) records[i] = from[i * count / size];
    }
};

struct bracket {
    float lo, hi;
};

/// Two keys between which the key of rank `left` of `count` lies in all likelihood: the order
/// statistics of a sample, 1.6 standard deviations to either side.
/// \source Floyd and Rivest, Expected Time Bounds for Selection, CACM 18 (1975)
bracket bracket_of(const record_sample& sample, std::size_t count, std::size_t left, int axis) {
    alignas(64) std::int32_t keys[record_sample::max_size + padding];
    alignas(64) std::int32_t rank[record_sample::max_size + padding];
    for (std::size_t i = 0; i < sample.size; ++i) {
        const auto bits = std::bit_cast<std::int32_t>(sample.records[i].center[axis]);
        const std::int32_t ordered = bits ^ ((bits >> 31) & 0x7FFFFFFF);
        keys[i] =
            (ordered & ~127) | static_cast<std::int32_t>(i);  // unique; the place matters more
    }
    std::fill_n(keys + sample.size, padding, std::numeric_limits<std::int32_t>::max());
    rank_by_counting(keys, sample.size, rank);

    const double share = static_cast<double>(left) / static_cast<double>(count);
    const double s = static_cast<double>(sample.size);
    const double spread = 1.6 * std::sqrt(share * (1.0 - share) * s) + 1.0;
    const auto lowest = static_cast<std::int32_t>(std::max(0.0, share * s - spread));
    const auto highest = static_cast<std::int32_t>(std::min(s - 1.0, share * s + spread));
    bracket result{};
    for (std::size_t i = 0; i < sample.size; ++i) {
        const float key = sample.records[i].center[axis];
        if (rank[i] == lowest) result.lo = key;
        if (rank[i] == highest) result.hi = key;
    }
    if (result.lo > result.hi) std::swap(result.lo, result.hi);
    return result;
}

/// How many records lie below a bracket of keys, and how many in it.
struct bracket_counts {
    std::size_t below, between;
};

/// Where `scatter` is: records below the bracket end at `below_end`, those above it begin at
/// `above_begin`, those between end at `between_end`.
struct scatter_ends {
    split_record* below_end;
    split_record* above_begin;
    split_record* between_end;
};

/// Without a branch: each record is written to all three places, and two are written again.
void scatter_one(const split_record& record, int axis, bracket b, scatter_ends& ends) {
    const float key = record.center[axis];
    const std::size_t is_below = key < b.lo;
    const std::size_t is_above = key > b.hi;
    const split_record copy = record;
    *ends.below_end = copy;
    *(ends.above_begin - 1) = copy;
    *ends.between_end = copy;
    ends.below_end += is_below;
    ends.above_begin -= is_above;
    ends.between_end += 1 - (is_below + is_above);
}

#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
/// The same for four records in one register. Returns how many records it took.
///
/// Between `below_end` and `above_begin` there is room for every record not yet taken, four at
/// least, so a whole register may be written to the former; to the latter, only what belongs there.
std::size_t scatter_vectors(const split_record* from, std::size_t count, int axis, bracket b,
                            scatter_ends& ends) {
    const hn::Full512<float> d;
    const hn::Full512<std::int32_t> di;
    alignas(64) std::int32_t lane_of_key[16];
    for (int lane = 0; lane < 16; ++lane) lane_of_key[lane] = lane / 4 * 4 + axis;
    const auto key_lanes = hn::SetTableIndices(d, lane_of_key);
    const auto lo = hn::Set(d, b.lo), hi = hn::Set(d, b.hi);
    std::size_t i = 0;
    for (; i + 4 <= count; i += 4) {
        const auto records = hn::LoadU(d, from[i].center);
        const auto last_first = hn::ReverseBlocks(d, records);
        const auto keys = hn::TableLookupLanes(records, key_lanes);
        const auto below = hn::Lt(keys, lo);
        const auto between = hn::Not(hn::Or(below, hn::Gt(keys, hi)));
        const auto above = hn::Gt(hn::TableLookupLanes(last_first, key_lanes), hi);
        hn::StoreU(hn::Compress(records, below), d, ends.below_end->center);
        hn::StoreU(hn::Compress(records, between), d, ends.between_end->center);
        const std::size_t lanes_above = hn::CountTrue(d, above);
        ends.above_begin -= lanes_above / 4;
        hn::BlendedStore(hn::Compress(last_first, above), hn::FirstN(d, lanes_above), d,
                         ends.above_begin->center);
        ends.below_end += hn::CountTrue(d, below) / 4;
        ends.between_end += hn::CountTrue(d, between) / 4;
    }
    return i;
}
#else
std::size_t scatter_vectors(const split_record*, std::size_t, int, bracket, scatter_ends&) {
    return 0;
}
#endif

/// Moves the records below the bracket on `axis` to the front of `to`, those above it to its back,
/// last first, and the few between to the front of `from`, whose records have been read by then.
///
/// \pre `to` has room for `count` records
bracket_counts scatter(split_record* from, split_record* to, std::size_t count, int axis,
                       bracket b) {
    scatter_ends ends{to, to + count, from};
    for (std::size_t i = scatter_vectors(from, count, axis, b, ends); i < count; ++i)
        scatter_one(from[i], axis, b, ends);
    return {static_cast<std::size_t>(ends.below_end - to),
            static_cast<std::size_t>(ends.between_end - from)};
}

void select_in_place(split_record* records, std::size_t count, std::size_t left, int axis) {
    if (left > 0 && left < count)
        std::nth_element(records, records + left, records + count,
                         [axis](const split_record& a, const split_record& b) {
                             return a.center[axis] < b.center[axis];
                         });
}

void split_any(split_record* from, split_record* to, std::size_t count, std::size_t left) {
    if (count <= max_ranked)
        return split_by_rank(from, to, count, widest_axis(range_of_records(from, count)));
    record_sample sample(from, count);
    const int axis = widest_axis(range_of_records(sample.records.data(), sample.size)).axis;
    for (;;) {
        const bracket cut = bracket_of(sample, count, left, axis);
        const auto [below, between] = scatter(from, to, count, axis, cut);
        const std::size_t above = count - below - between;
        // `to` has a gap of `between` places behind `below`, where the cut should fall.
        const bool found = below <= left && left <= below + between;
        if (!found || between > count - count / 4) {  // bad luck, or many equal keys
            std::copy_n(from, between, to + below);
            if (left < below) return select_in_place(to, below, left, axis);
            if (left > below + between)
                return select_in_place(to + below + between, above, left - below - between, axis);
            return select_in_place(to + below, between, left - below, axis);
        }
        to += below;
        left -= below;
        count = between;
        if (count <= max_ranked) return split_by_rank(from, to, count, {axis, cut.lo, cut.hi});
        sample = record_sample(from, count);
    }
}

struct split_buffers {
    split_record* even;
    split_record* odd;
};

struct moved_part {
    split_record* from;
    split_record* to;
};

moved_part places_of(const split_buffers& buffers, const split_part& part) {
    const auto [even, odd] = buffers;
    return part.round % 2 == 0 ? moved_part{even + part.begin, odd + part.begin}
                               : moved_part{odd + part.begin, even + part.begin};
}

/// A part of few records. `range` holds their centers; it is passed down, cut where the part was
/// cut, instead of being found anew: on the other axes it is then wider than need be.
void split_few(const split_buffers& buffers, const split_plan& plan, const split_part& part,
               const center_range& range) {
    const auto [begin, count, round] = part;
    if (round == plan.rounds()) return;
    const auto [from, to] = places_of(buffers, part);
    const std::size_t middle = plan.left(count, round);
    if (middle == count) {
        std::copy_n(from, count, to);
        return split_few(buffers, plan, {begin, count, round + 1}, range);
    }
    const split_axis axis = widest_axis(range);
    split_by_rank(from, to, count, axis);
    // Ranked records are sorted, up to the rounding of their keys; ranges need not be exact.
    center_range left = range, right = range;
    left.max[axis.axis] = right.min[axis.axis] = to[middle].center[axis.axis];
    split_few(buffers, plan, {begin, middle, round + 1}, left);
    split_few(buffers, plan, {begin + middle, count - middle, round + 1}, right);
}

void split_part_to_leaves(const split_buffers& buffers, const split_plan& plan,
                          const split_part& part) {
    const auto [begin, count, round] = part;
    const auto [from, to] = places_of(buffers, part);
    if (count <= max_ranked) return split_few(buffers, plan, part, range_of_records(from, count));
    const std::size_t middle = plan.left(count, round);
    if (middle == count)
        std::copy_n(from, count, to);
    else
        split_any(from, to, count, middle);
    split_part_to_leaves(buffers, plan, {begin, middle, round + 1});
    if (middle < count)
        split_part_to_leaves(buffers, plan, {begin + middle, count - middle, round + 1});
}

void split_all(split_record* even, split_record* odd, const split_plan& plan,
               const split_part& part) {
    split_part_to_leaves({even, odd}, plan, part);
}

}  // namespace
}  // namespace treeform::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace treeform::detail {

HWY_EXPORT(range_of_records);
HWY_EXPORT(split_any);
HWY_EXPORT(split_all);

center_range range_of(const split_record* records, std::size_t count) {
    return HWY_DYNAMIC_DISPATCH(range_of_records)(records, count);
}

void split(split_record* from, split_record* to, std::size_t count, std::size_t left) {
    HWY_DYNAMIC_DISPATCH(split_any)(from, to, count, left);
}

void split_to_leaves(split_record* even, split_record* odd, const split_plan& plan,
                     const split_part& part) {
    HWY_DYNAMIC_DISPATCH(split_all)(even, odd, plan, part);
}

}  // namespace treeform::detail
#endif
