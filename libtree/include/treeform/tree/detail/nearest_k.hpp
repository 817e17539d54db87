#pragma once
/// \file
/// Keeps the k nearest of all neighbors offered.

#include <treeform/tree/answers.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace treeform::detail {

/// Keeps the k nearest of all neighbors offered. If k is small, they are sorted by insertion;
/// otherwise they are a heap with the furthest on top.
template <class Neighbor>
class nearest_k {
  public:
    nearest_k(std::size_t k, double squared_radius) : k_(k) {
        kept_.reserve(std::min<std::size_t>(k, 4096));  // k may be the number of all primitives
        reset(squared_radius);
    }

    void offer(Neighbor one) {
        if (!(one.squared_distance() <= bound_)) return;  // NaN is not
        if (kept_.size() == k_) {
            if (!nearer(one, furthest())) return;
            if (!few()) std::pop_heap(kept_.begin(), kept_.end(), order);
            kept_.pop_back();
        }
        kept_.push_back(std::move(one));
        if (few())
            for (auto at = kept_.end() - 1; at != kept_.begin() && nearer(*at, *(at - 1)); --at)
                std::swap(*at, *(at - 1));
        else
            std::push_heap(kept_.begin(), kept_.end(), order);
        if (kept_.size() == k_) bound_ = furthest().squared_distance();
    }

    /// The largest squared distance at which another neighbor would be kept.
    [[nodiscard]] double bound() const { return bound_; }

    /// Whether no other offer can be nearer: k neighbors at distance zero are kept.
    [[nodiscard]] bool done() const { return kept_.size() == k_ && bound_ <= 0.0; }

    /// The neighbors kept, nearest first. Call `reset` before the next offer.
    [[nodiscard]] std::vector<Neighbor>& sorted() {
        if (!few()) std::sort_heap(kept_.begin(), kept_.end(), order);
        return kept_;
    }

    /// Removes all neighbors; keeps the memory.
    void reset(double squared_radius) {
        kept_.clear();
        bound_ = k_ == 0 ? -1.0 : squared_radius;
    }

  private:
    /// By `nearer`, found by argument-dependent lookup.
    static constexpr auto order = [](const Neighbor& a, const Neighbor& b) { return nearer(a, b); };

    [[nodiscard]] bool few() const { return k_ <= 32; }
    [[nodiscard]] const Neighbor& furthest() const { return few() ? kept_.back() : kept_.front(); }

    std::size_t k_;
    double bound_;
    std::vector<Neighbor> kept_;
};

}  // namespace treeform::detail
