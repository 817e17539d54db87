#pragma once
/// \file
/// Three methods to find all pairs of points within a tolerance, for clouds with few pairs.

#include <libmesh/weld/lattice.hpp>
#include <libmesh/weld/reach.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/answers.hpp>
#include <treeform/tree/detail/function_ref.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

namespace treeform::detail::weld {

/// Parameters and callbacks of a search. Both callbacks are called from several threads at once.
/// Points that are not finite are in no pair.
struct near_pairs_task {
    points_view points;
    double tolerance;
    std::span<const std::uint32_t> label;  ///< [V] only pairs with equal labels; empty: all pairs
    /// Equal points with the same label may be reported once, to `copies`, and then be in no pair.
    bool collapse;
    function_ref<void(std::uint32_t first, std::uint32_t copy)> copies;  ///< first < copy
    /// Receives the pairs within the tolerance, decided exactly, in any order; some pairs twice.
    /// Returns false to stop the search.
    function_ref<bool(std::span<const id_pair>)> pairs;
};

/// Each returns whether the search is complete: false when `pairs` stopped it, or when it would
/// take too long. Pairs and copies reported until then are correct.
[[nodiscard]] bool pairs_by_window(const near_pairs_task& task, const lattice& steps);
[[nodiscard]] bool pairs_by_cells(const near_pairs_task& task, const lattice& steps);
[[nodiscard]] bool pairs_by_tree(const near_pairs_task& task);

/// Average number of points in a window, estimated from a sample of a few thousand.
[[nodiscard]] double estimated_window(points_view points, const lattice& steps);
/// Number of points in a window at which windows are as slow as cells.
inline constexpr double wide_window = 384.0;

/// Collects and filters candidate pairs of one thread, and passes them on in blocks.
class pair_collector {
  public:
    explicit pair_collector(const near_pairs_task& task) : task_(task), within_(task.tolerance) {}

    /// Returns false when the search was stopped, in this and in all other threads.
    bool add(std::uint32_t a, std::uint32_t b, lattice::verdict known) {
        if (known == lattice::verdict::beyond) return true;
        if (!task_.label.empty() && task_.label[a] != task_.label[b]) return true;
        if (known == lattice::verdict::unsure && !within_.holds(task_.points[a], task_.points[b]))
            return true;
        block_[size_++] = {a, b};
        return size_ < block_.size() || flush();
    }

    bool flush() {
        const bool more = size_ == 0 || task_.pairs({block_.data(), size_});
        size_ = 0;
        return more;
    }

  private:
    const near_pairs_task& task_;
    reach within_;
    std::array<id_pair, 1024> block_;
    std::size_t size_ = 0;
};

[[nodiscard]] inline bool equal(const point3& a, const point3& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/// Removes from `bucket` the points that equal an earlier one next to them, and returns the number
/// of points left. `together(a, b)` tells whether two records differ only in their point number;
/// such records are in ascending order of it.
template <class Record, class Together>
std::size_t collapse_equal(const near_pairs_task& task, std::span<Record> bucket,
                           const Together& together) {
    if (!task.collapse) return bucket.size();
    std::size_t i = 0;
    for (i = 1; i < bucket.size(); ++i)
        if (together(bucket[i - 1], bucket[i])) {
            __builtin_prefetch(&task.points[bucket[i - 1].id]);
            __builtin_prefetch(&task.points[bucket[i].id]);
        }
    std::size_t kept = 0;
    std::size_t first = 0;
    for (i = 0; i < bucket.size(); ++i) {
        const Record record = bucket[i];
        if (kept == 0 || !together(bucket[first], record)) {
            first = kept;
        } else if (const std::uint32_t a = bucket[first].id, b = record.id;
                   equal(task.points[a], task.points[b]) &&
                   (task.label.empty() || task.label[a] == task.label[b])) {
            task.copies(a, b);
            continue;
        }
        bucket[kept++] = record;
    }
    return kept;
}

}  // namespace treeform::detail::weld
