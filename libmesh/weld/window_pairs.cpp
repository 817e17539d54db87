#include <libmesh/weld/near_pairs.hpp>
#include <libmesh/weld/sort_by_key.hpp>

#include <bit>
#include <limits>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libmesh/weld/window_pairs.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef TREEFORM_WINDOW_PAIRS_ONCE
#define TREEFORM_WINDOW_PAIRS_ONCE
namespace treeform::detail::weld {
namespace {

/// Records of one chunk and those behind it that its windows reach, ascending by s. Behind them
/// `padding` records whose s is beyond every window.
struct window_arrays {
    static constexpr std::size_t padding = 32;
    std::vector<std::int32_t> s, x, y;
    std::vector<std::uint32_t> id;
    std::size_t own = 0;

    void clear() {
        for (auto* numbers : {&s, &x, &y}) numbers->clear();
        id.clear();
    }
    void add(std::span<const lattice_record> records) {
        for (const lattice_record& r : records) {
            s.push_back(r.s);
            x.push_back(r.x);
            y.push_back(r.y);
            id.push_back(r.id);
        }
    }
    void pad() {
        s.insert(s.end(), padding, std::numeric_limits<std::int32_t>::max());
        for (auto* numbers : {&x, &y}) numbers->insert(numbers->end(), padding, 0);
    }
    [[nodiscard]] lattice_record record(std::size_t i) const { return {s[i], x[i], y[i], id[i]}; }
};

using window_hit = function_ref<bool(std::size_t i, std::size_t j)>;

}  // namespace
}  // namespace treeform::detail::weld
#endif

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::weld::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Calls `hit` for the pairs i < j, i < own, whose s, x and y are all within reach, until it
/// returns false or more than `most` pairs were looked at, of which a hit costs as much as 64. A
/// lane is an i; step k meets it with i + k.
bool scan_window(const window_arrays& arrays, const lattice& steps, std::size_t most,
                 const window_hit& hit) {
    const hn::CappedTag<std::int32_t, 16> d;
    const std::size_t lanes = hn::Lanes(d);
    const auto along = hn::Set(d, steps.reach_along() + 1);
    const auto across = hn::Set(d, steps.reach() + 1);
    constexpr std::size_t per_hit = 64;
    std::size_t taken = 0;
    for (std::size_t i = 0; i < arrays.own; i += lanes) {
        const auto live = hn::FirstN(d, arrays.own - i);
        const auto s = hn::LoadU(d, arrays.s.data() + i);
        const auto x = hn::LoadU(d, arrays.x.data() + i);
        const auto y = hn::LoadU(d, arrays.y.data() + i);
        for (std::size_t j = i + 1; taken <= most; ++j, taken += lanes) {
            const auto ahead = hn::Sub(hn::LoadU(d, arrays.s.data() + j), s);
            const auto in_window = hn::And(hn::Lt(ahead, along), live);
            if (hn::AllFalse(d, in_window)) break;
            const auto off_x = hn::Abs(hn::Sub(hn::LoadU(d, arrays.x.data() + j), x));
            const auto off_y = hn::Abs(hn::Sub(hn::LoadU(d, arrays.y.data() + j), y));
            const auto near = hn::And(in_window, hn::Lt(hn::Max(off_x, off_y), across));
            if (HWY_LIKELY(hn::AllFalse(d, near))) continue;
            std::uint8_t bytes[8] = {};
            hn::StoreMaskBits(d, near, bytes);
            for (unsigned bits = bytes[0] | unsigned{bytes[1]} << 8; bits != 0; bits &= bits - 1) {
                const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
                taken += per_hit;
                if (!hit(i + lane, j + lane)) return false;
            }
        }
        if (taken > most) return false;
    }
    return true;
}

}  // namespace
}  // namespace treeform::detail::weld::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace treeform::detail::weld {

HWY_EXPORT(scan_window);

namespace {

using sorted_points = sorted_records<lattice_record>;

sorted_points sort_along(const near_pairs_task& task, const lattice& steps) {
    const key_bits bits(task.points.size());
    const int shift = lattice::steps_bits - bits.all();
    const auto key = [shift](const lattice_record& r) {
        return static_cast<std::uint32_t>(r.s) >> shift;
    };
    auto sorted = distribute<lattice_record>(
        task.points.size(), bits,
        [&](std::size_t i, lattice_record& r) {
            if (!base::is_finite(task.points[i])) return false;
            r = steps.record(task.points[i], static_cast<std::uint32_t>(i));
            return true;
        },
        key);
    const auto place = [](const lattice_record& r) {
        return std::uint64_t{static_cast<std::uint32_t>(r.s)} << 32 |
               static_cast<std::uint32_t>(r.x);
    };
    sort_buckets(
        sorted, bits, key,
        [&](const lattice_record& a, const lattice_record& b) {
            if (place(a) != place(b)) return place(a) < place(b);
            return a.y != b.y ? a.y < b.y : a.id < b.id;
        },
        [&](std::size_t, std::span<lattice_record> bucket) {
            return collapse_equal(task, bucket,
                                  [&](const lattice_record& a, const lattice_record& b) {
                                      return place(a) == place(b) && a.y == b.y;
                                  });
        });
    return sorted;
}

/// The records of buckets [begin, end), and those behind them within a window of the last.
/// Returns false where these are more than `most`.
bool gather(const sorted_points& sorted, const lattice& steps, std::size_t begin, std::size_t end,
            std::size_t most, window_arrays& arrays) {
    arrays.clear();
    for (std::size_t b = begin; b < end; ++b) arrays.add(sorted.bucket(b));
    arrays.own = arrays.s.size();
    if (arrays.own == 0) return true;
    const std::int32_t last = arrays.s.back() + steps.reach_along();
    for (std::size_t b = end; b < sorted.size.size(); ++b) {
        const std::span<const lattice_record> bucket = sorted.bucket(b);
        const auto behind =
            std::upper_bound(bucket.begin(), bucket.end(), last,
                             [](std::int32_t s, const lattice_record& r) { return s < r.s; });
        arrays.add(bucket.first(static_cast<std::size_t>(behind - bucket.begin())));
        if (behind != bucket.end()) break;
        if (arrays.s.size() > most) return false;
    }
    arrays.pad();
    return true;
}

}  // namespace

bool pairs_by_window(const near_pairs_task& task, const lattice& steps) {
    constexpr std::size_t chunk = 16384;
    constexpr std::size_t patience = 2048;  // pairs a point, more than any other way looks at
    const sorted_points sorted = sort_along(task, steps);
    const std::size_t buckets = sorted.size.size();
    const std::size_t average = sorted.records.size() / buckets + 1;
    std::atomic<bool> stopped = false;
    for_chunks(buckets, std::max<std::size_t>(1, chunk / average),
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   if (stopped.load(std::memory_order_relaxed)) return;
                   window_arrays arrays;
                   pair_collector found(task);
                   const bool done =
                       gather(sorted, steps, begin, end, patience * chunk, arrays) &&
                       HWY_DYNAMIC_DISPATCH(scan_window)(
                           arrays, steps, patience * (chunk + arrays.own),
                           [&](std::size_t i, std::size_t j) {
                               return found.add(arrays.id[i], arrays.id[j],
                                                steps.compare(arrays.record(i), arrays.record(j)));
                           }) &&
                       found.flush();
                   if (!done) stopped.store(true, std::memory_order_relaxed);
               });
    return !stopped;
}

double estimated_window(points_view points, const lattice& steps) {
    constexpr std::size_t sample = 4096;
    std::vector<std::int32_t> along;
    const std::size_t stride = std::max<std::size_t>(1, points.size() / sample);
    for (std::size_t i = 0; i < points.size(); i += stride)
        if (base::is_finite(points[i])) along.push_back(steps.record(points[i], 0).s);
    std::sort(along.begin(), along.end());
    std::size_t pairs = 0;
    for (std::size_t i = 0, j = 0; i < along.size(); ++i) {
        while (j < along.size() && along[j] - along[i] <= steps.reach_along()) ++j;
        pairs += j - i - 1;
    }
    if (along.empty()) return 0.0;
    const auto n = static_cast<double>(along.size());
    return static_cast<double>(pairs) / n * (static_cast<double>(points.size()) / n);
}

}  // namespace treeform::detail::weld
#endif
