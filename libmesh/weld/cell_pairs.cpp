#include <libmesh/base/point_math.hpp>
#include <libmesh/weld/near_pairs.hpp>
#include <libmesh/weld/sort_by_key.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/search.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace treeform::detail::weld {
namespace {

/// Cubes at least twice as wide as the reach, and about a third of what a point would have to
/// itself if the points filled their box: what lies on surfaces has a few points a cube then.
class cubes {
  public:
    cubes(std::size_t points, const lattice& steps, int key_bits)
        : shift_(64 - key_bits), reach_(steps.reach()) {
        double volume = 1.0;
        for (const double e : steps.extent()) volume *= std::max(e, 1.0);
        const double own = std::cbrt(volume / static_cast<double>(points + 1)) / 3.0;
        const double width = std::clamp(own, 2.0 * reach_ + 2.0, 0x1p30);
        per_step_ = static_cast<std::uint64_t>(0x1p32 / width);
    }

    [[nodiscard]] std::uint32_t cell(std::int32_t at) const {
        const std::int64_t ahead = std::int64_t{at} + reach_;  // not negative for any at - reach
        return static_cast<std::uint32_t>(static_cast<std::uint64_t>(ahead) * per_step_ >> 32);
    }
    [[nodiscard]] std::uint32_t key(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        std::uint64_t h = x * 0x9e3779b97f4a7c15;
        h = (h ^ h >> 32 ^ y) * 0xd1342543de82ef95;
        h = (h ^ h >> 32 ^ z) * 0xaf251af3b0f025b5;
        return static_cast<std::uint32_t>(h >> shift_);
    }
    [[nodiscard]] std::uint32_t key(const place_record& r) const {
        return key(cell(r.x), cell(r.y), cell(r.z));
    }
    [[nodiscard]] std::int32_t reach() const { return reach_; }

  private:
    std::uint64_t per_step_ = 1;
    int shift_;
    std::int32_t reach_;
};

using sorted_places = sorted_records<place_record>;

bool same_place(const place_record& a, const place_record& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/// The points by the key of their cube. `first_of_key[k]` is the place of the first of key k, or
/// of a later key; the last entry is the end.
sorted_places sort_by_cube(const near_pairs_task& task, const lattice& steps, const key_bits& bits,
                           const cubes& grid, buffer<std::uint32_t>& first_of_key) {
    const auto key = [&](const place_record& r) { return grid.key(r); };
    auto sorted = distribute<place_record>(
        task.points.size(), bits,
        [&](std::size_t i, place_record& r) {
            if (!base::is_finite(task.points[i])) return false;
            r = steps.place(task.points[i], static_cast<std::uint32_t>(i));
            return true;
        },
        key);
    sort_buckets(
        sorted, bits, key,
        [](const place_record& a, const place_record& b) {
            if (a.x != b.x) return a.x < b.x;
            if (a.y != b.y) return a.y < b.y;
            return a.z != b.z ? a.z < b.z : a.id < b.id;
        },
        [&](std::size_t b, std::span<place_record> bucket) {
            const std::size_t size = collapse_equal(task, bucket, same_place);
            auto k = static_cast<std::uint32_t>(b << bits.fine);
            const auto begin = static_cast<std::uint32_t>(sorted.begin[b]);
            for (std::uint32_t i = 0; i < size; ++i)
                for (const std::uint32_t own = grid.key(bucket[i]); k <= own; ++k)
                    first_of_key[k] = begin + i;
            for (; k < (b + 1) << bits.fine; ++k)
                first_of_key[k] = begin + static_cast<std::uint32_t>(size);
            return size;
        });
    return sorted;
}

/// What one thread does: looks from the records of some buckets at those near them.
class cell_scan {
  public:
    cell_scan(const near_pairs_task& task, const lattice& steps, const key_bits& bits,
              const cubes& grid, const sorted_places& sorted,
              std::span<const std::uint32_t> first_of_key)
        : steps_(steps),
          bits_(bits),
          grid_(grid),
          sorted_(sorted),
          first_of_key_(first_of_key),
          found_(task) {}

    /// Returns false where there is no more to do, or too much.
    bool scan(std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end && more_; ++b) {
            const std::span<const place_record> bucket = sorted_.bucket(b);
            own_ += bucket.size();
            for (std::size_t i = 0; i < bucket.size() && more_; ++i) look_from(bucket[i]);
            if (taken_ > patience * own_) more_ = false;
        }
        return more_ && found_.flush();
    }

    static constexpr std::size_t chunk = 16384;

  private:
    static constexpr std::size_t patience = 1024;  // comparisons a point; a hit costs as 32
    static constexpr std::size_t per_hit = 32;

    /// Cubes within reach; each pair of cubes is looked at from the lower one.
    void look_from(const place_record& a) {
        const std::uint32_t x = grid_.cell(a.x), y = grid_.cell(a.y), z = grid_.cell(a.z);
        const std::uint32_t key = grid_.key(x, y, z);
        meet(a, &a + 1, end_of_key(key));
        const std::int32_t r = grid_.reach();
        for (std::uint32_t cx = x; cx <= grid_.cell(a.x + r); ++cx)
            for (std::uint32_t cy = cx == x ? y : grid_.cell(a.y - r); cy <= grid_.cell(a.y + r);
                 ++cy)
                for (std::uint32_t cz = cx == x && cy == y ? z + 1 : grid_.cell(a.z - r);
                     cz <= grid_.cell(a.z + r); ++cz)
                    if (const std::uint32_t k = grid_.key(cx, cy, cz); k != key)
                        meet(a, sorted_.records.data() + first_of_key_[k], end_of_key(k));
    }

    void meet(const place_record& a, const place_record* b, const place_record* last) {
        taken_ += static_cast<std::size_t>(last - b);
        for (; b != last && more_ && taken_ <= patience * own_; ++b)
            if (near(a, *b)) {
                taken_ += per_hit;
                more_ = found_.add(a.id, b->id, steps_.compare(a, *b));
            }
    }

    [[nodiscard]] bool near(const place_record& a, const place_record& b) const {
        return std::abs(a.x - b.x) <= grid_.reach() && std::abs(a.y - b.y) <= grid_.reach() &&
               std::abs(a.z - b.z) <= grid_.reach();
    }

    /// A bucket's last key ends where the bucket does.
    [[nodiscard]] const place_record* end_of_key(std::uint32_t k) const {
        const std::size_t b = k >> bits_.fine;
        const std::size_t next = std::size_t{k} + 1;
        return sorted_.records.data() +
               (next >> bits_.fine == b ? first_of_key_[next] : sorted_.begin[b] + sorted_.size[b]);
    }

    const lattice& steps_;
    const key_bits& bits_;
    const cubes& grid_;
    const sorted_places& sorted_;
    std::span<const std::uint32_t> first_of_key_;
    pair_collector found_;
    std::size_t taken_ = 0;
    std::size_t own_ = chunk;
    bool more_ = true;
};

}  // namespace

bool pairs_by_tree(const near_pairs_task& task) {
    constexpr double big = std::numeric_limits<double>::infinity();
    constexpr std::uint64_t patience = 64;  // candidates a point
    std::vector<std::uint32_t> finite;
    for (std::uint32_t i = 0; i < task.points.size(); ++i)
        if (base::is_finite(task.points[i])) finite.push_back(i);
    // Boxes of points within the tolerance overlap: half of it, rounded up, on each side.
    const double half = std::nextafter(0.5 * task.tolerance, big);
    bool bounded = true;
    for (const std::uint32_t i : finite) {
        const point3& p = task.points[i];
        const double largest = base::largest_of(p);
        bounded = bounded && largest < 0x1p1022 && half < 0x1p1022;
    }
    if (!bounded) return false;
    const auto tree = build(finite, [&](std::uint32_t i) {
        const point3& p = task.points[i];
        aabb<double, 3> box;
        for (std::size_t k = 0; k < 3; ++k) {
            box.min[k] = std::nextafter(p[k] - half, -big);
            box.max[k] = std::nextafter(p[k] + half, big);
        }
        return box;
    });

    const self_search_chunks<3> search(tree);
    const std::uint64_t most = patience * (finite.size() + 1024);
    std::atomic<std::uint64_t> taken = 0;
    std::atomic<bool> stopped = false;
    for_chunks(search.chunks(), 1, [&](std::size_t chunk, std::size_t, std::size_t) {
        if (stopped.load(std::memory_order_relaxed)) return;
        pair_collector found(task);
        const auto visit = [&](const candidate_block& block) {
            for (std::size_t i = 0; i < block.first.size(); ++i)
                if (!found.add(finite[tree.ids()[block.first[i]]],
                               finite[tree.ids()[block.second[i]]], lattice::verdict::unsure))
                    stopped.store(true, std::memory_order_relaxed);
            if (taken.fetch_add(block.first.size(), std::memory_order_relaxed) > most)
                stopped.store(true, std::memory_order_relaxed);
            return !stopped.load(std::memory_order_relaxed);
        };
        static_cast<void>(search.visit(chunk, visit));
        if (!found.flush()) stopped.store(true, std::memory_order_relaxed);
    });
    return !stopped;
}

bool pairs_by_cells(const near_pairs_task& task, const lattice& steps) {
    const key_bits bits(task.points.size());
    const cubes grid(task.points.size(), steps, bits.all());
    buffer<std::uint32_t> first_of_key((std::size_t{1} << bits.all()) + 1);
    const sorted_places sorted = sort_by_cube(task, steps, bits, grid, first_of_key);
    const std::size_t buckets = sorted.size.size();
    const std::size_t average = sorted.records.size() / buckets + 1;
    std::atomic<bool> stopped = false;
    for_chunks(buckets, std::max<std::size_t>(1, cell_scan::chunk / average),
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   if (stopped.load(std::memory_order_relaxed)) return;
                   cell_scan mine(task, steps, bits, grid, sorted, first_of_key.span());
                   if (!mine.scan(begin, end)) stopped.store(true, std::memory_order_relaxed);
               });
    return !stopped;
}

}  // namespace treeform::detail::weld
