#pragma once
/// \file
/// Progress of searches for pairs of faces, and joining the outputs of their chunks.

#include <libmesh/intersect/narrow_phase.hpp>
#include <libmesh/intersect/sort_pairs.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <mutex>
#include <vector>

namespace treeform::detail::intersect {

/// Reports the progress of a search, from any thread, and whether it is cancelled.
class search_progress {
  public:
    search_progress(const progress_callback& callback, std::size_t chunks)
        : callback_(callback), chunks_(chunks) {}

    [[nodiscard]] bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

    void chunk_done() {
        if (!callback_) return;
        const std::lock_guard lock(mutex_);
        const double done = static_cast<double>(++done_) / static_cast<double>(chunks_);
        if (!cancelled() && !callback_(done)) cancelled_ = true;
    }

  private:
    const progress_callback& callback_;
    std::size_t chunks_;
    std::size_t done_ = 0;
    std::mutex mutex_;
    std::atomic<bool> cancelled_{false};
};

/// Keeps only one pair: the lowest of the first chunk that has any. The pairs of later chunks
/// depend on timing.
inline void keep_first(std::vector<narrow_phase_output>& found) {
    const auto first = std::find_if(found.begin(), found.end(),
                                    [](const auto& output) { return !output.pairs.empty(); });
    if (first == found.end()) return;
    const face_pair pair = *std::min_element(first->pairs.begin(), first->pairs.end());
    first->pairs = {pair};
    first->counts = {};
    first->counts[static_cast<std::size_t>(pair.kind)] = 1;
    std::fill(first + 1, found.end(), narrow_phase_output{});
}

/// Adds the outputs to `result`, which has the same fields: the lowest `limit` pairs, and all
/// counts.
template <class Result>
void join_outputs(std::vector<narrow_phase_output>& found, std::size_t limit, Result& result) {
    std::size_t total = 0;
    for (const narrow_phase_output& output : found) total += output.pairs.size();
    result.pairs.reserve(total);
    for (narrow_phase_output& output : found) {
        result.pairs.insert(result.pairs.end(), output.pairs.begin(), output.pairs.end());
        output.pairs = {};
        for (std::size_t k = 0; k < pair_kind_count; ++k) result.counts[k] += output.counts[k];
        result.box_pairs += output.box_pairs;
        result.exact_pairs += output.exact_pairs;
        result.predicates += output.predicates;
    }
    const std::size_t kept = std::min(limit, total);
    if (kept < total) {
        const auto end = result.pairs.begin() + static_cast<std::ptrdiff_t>(kept);
        std::nth_element(result.pairs.begin(), end, result.pairs.end());
        result.pairs.resize(kept);
    }
    sort_pairs(result.pairs);
}

}  // namespace treeform::detail::intersect
