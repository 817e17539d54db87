#include <libmesh/base/for_numbers.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/weld/group_points.hpp>
#include <libmesh/weld/near_pairs.hpp>
#include <libmesh/weld/reach.hpp>
#include <libmesh/weld/sort_by_key.hpp>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <numeric>
#include <optional>

namespace treeform::detail::weld {
namespace {

/// Pairs by the search asked for. The other ways help where a window or a cell holds too many.
bool find_pairs(const near_pairs_task& task, neighbor_search search) {
    if (search == neighbor_search::tree) return pairs_by_tree(task);
    const std::optional<lattice> steps = lattice::over(task.points, task.tolerance);
    if (!steps) return false;
    if (search == neighbor_search::automatic)
        search = estimated_window(task.points, *steps) < wide_window ? neighbor_search::window
                                                                     : neighbor_search::cells;
    return search == neighbor_search::window ? pairs_by_window(task, *steps)
                                             : pairs_by_cells(task, *steps);
}

/// A pair of points, lower one last: sorted, the earlier neighbors of each point stand together.
struct earlier_neighbor {
    std::uint32_t point;
    std::uint32_t earlier;
};

class pair_list {
  public:
    explicit pair_list(std::size_t most) : pairs_(most) {}

    bool add(std::span<const id_pair> pairs) {
        const std::size_t at = size_.fetch_add(pairs.size(), std::memory_order_relaxed);
        if (at + pairs.size() > pairs_.size()) return false;
        for (std::size_t i = 0; i < pairs.size(); ++i)
            pairs_[at + i] = {std::max(pairs[i].first, pairs[i].second),
                              std::min(pairs[i].first, pairs[i].second)};
        return true;
    }

    /// By point, then by earlier one, whatever the order in which they came.
    [[nodiscard]] sorted_records<earlier_neighbor> sorted(std::size_t points) {
        const key_bits bits(size_);
        const int shift = std::max(0, static_cast<int>(std::bit_width(points)) - bits.all());
        const auto key = [&](const earlier_neighbor& pair) { return pair.point >> shift; };
        auto result = distribute<earlier_neighbor>(
            size_, bits,
            [&](std::size_t i, earlier_neighbor& pair) {
                pair = pairs_[i];
                return true;
            },
            key);
        pairs_ = {};
        sort_buckets(
            result, bits, key,
            [](const earlier_neighbor& a, const earlier_neighbor& b) {
                return a.point != b.point ? a.point < b.point : a.earlier < b.earlier;
            },
            [](std::size_t, std::span<earlier_neighbor> bucket) { return bucket.size(); });
        return result;
    }

  private:
    buffer<earlier_neighbor> pairs_;
    std::atomic<std::size_t> size_ = 0;
};

/// Kept points that are nearer to a dropped one than its leader, but later than it: they are what
/// its later copies may belong to.
using later_leaders = std::vector<earlier_neighbor>;  // point: the kept one; earlier: the dropped

void decide(points_view points, std::span<const earlier_neighbor> neighbors, bool copies,
            std::vector<std::uint32_t>& leader_of, later_leaders& later) {
    constexpr std::size_t ahead = 16;
    for (std::size_t i = 0; i < neighbors.size();) {
        const std::uint32_t point = neighbors[i].point;
        const std::size_t begin = i;
        nearest_kept best(points[point]);
        for (; i < neighbors.size() && neighbors[i].point == point; ++i) {
            if (i + ahead < neighbors.size())
                __builtin_prefetch(&leader_of[neighbors[i + ahead].earlier]);
            const std::uint32_t other = neighbors[i].earlier;
            if (leader_of[other] == other) best.consider(other, points[other]);
        }
        if (best.any()) {
            leader_of[point] = static_cast<std::uint32_t>(best.id());
        } else if (copies) {
            for (std::size_t k = begin; k < i; ++k) {
                const std::uint32_t dropped = neighbors[k].earlier;
                if (reach::compare(points[dropped], points[point], points[leader_of[dropped]]) < 0)
                    later.push_back({point, dropped});
            }
        }
    }
}

/// Copies name the point they equal. Where that was dropped, they belong to its leader, or to a
/// nearer one that came between.
void place_copies(points_view points, later_leaders& later, std::vector<std::uint32_t>& leader_of) {
    const auto by_dropped = [](const earlier_neighbor& a, const earlier_neighbor& b) {
        return a.earlier != b.earlier ? a.earlier < b.earlier : a.point < b.point;
    };
    std::sort(later.begin(), later.end(), by_dropped);
    for_chunks(leader_of.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t dropped = leader_of[i];
            std::uint32_t best = leader_of[dropped];
            if (best == dropped) continue;
            for (auto at = std::lower_bound(later.begin(), later.end(),
                                            earlier_neighbor{0, dropped}, by_dropped);
                 at != later.end() && at->earlier == dropped && at->point < i; ++at)
                if (reach::compare(points[dropped], points[at->point], points[best]) < 0)
                    best = at->point;
            leader_of[i] = best;
        }
    });
}

/// Passes on the pairs that agree; without `may_merge`, all as they are.
class agreeing {
  public:
    explicit agreeing(const weld_options& options) : options_(&options) {}

    template <class Sink>
    bool operator()(std::span<const id_pair> pairs, const Sink& sink) const {
        if (!options_->may_merge) return sink(pairs);
        std::vector<id_pair> agreed;
        for (const id_pair& pair : pairs)
            if (options_->may_merge(pair.first, pair.second)) agreed.push_back(pair);
        return sink(std::span<const id_pair>(agreed));
    }

  private:
    const weld_options* options_;
};

}  // namespace

std::vector<std::uint32_t> sparse_leaders(points_view points, const weld_options& options,
                                          neighbor_search search) {
    std::vector<std::uint32_t> leader_of(points.size());
    std::iota(leader_of.begin(), leader_of.end(), 0U);
    pair_list pairs(points.size() + points.size() / 4 + 1024);
    std::atomic<bool> copies = false;
    const agreeing agree(options);
    const auto add_copy = [&](std::uint32_t first, std::uint32_t copy) {
        leader_of[copy] = first;  // a point is a copy once
        if (!copies.load(std::memory_order_relaxed)) copies.store(true, std::memory_order_relaxed);
    };
    const auto add_pairs = [&](std::span<const id_pair> found) {
        return agree(found, [&](std::span<const id_pair> agreed) { return pairs.add(agreed); });
    };
    const near_pairs_task task{points,   options.tolerance, options.label, !options.may_merge,
                               add_copy, add_pairs};
    if (!find_pairs(task, search)) return {};
    if (options.progress && !options.progress(0.7)) return {};

    const sorted_records<earlier_neighbor> sorted = pairs.sorted(points.size());
    later_leaders later;
    decide(points, sorted.records.span(), copies, leader_of, later);
    if (copies) place_copies(points, later, leader_of);
    return leader_of;
}

std::vector<std::uint32_t> sparse_chains(points_view points, const weld_options& options,
                                         neighbor_search search) {
    const std::size_t most = 16 * points.size() + 1024;
    base::union_find sets(points.size());
    std::atomic<std::size_t> count = 0;
    const agreeing agree(options);
    const auto add_copy = [&](std::uint32_t first, std::uint32_t copy) { sets.join(first, copy); };
    const auto add_pairs = [&](std::span<const id_pair> found) {
        return agree(found, [&](std::span<const id_pair> agreed) {
            for (const id_pair& pair : agreed) sets.join(pair.first, pair.second);
            return count.fetch_add(found.size(), std::memory_order_relaxed) < most;
        });
    };
    const near_pairs_task task{points,   options.tolerance, options.label, !options.may_merge,
                               add_copy, add_pairs};
    if (!find_pairs(task, search)) return {};
    std::vector<std::uint32_t> root_of(points.size());
    base::for_numbers(points.size(), [&](std::size_t i) {
        root_of[i] = sets.root(static_cast<std::uint32_t>(i));
    });
    return root_of;
}

}  // namespace treeform::detail::weld
