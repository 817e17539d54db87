#pragma once
/// \file
/// Disjoint sets that several threads may join at the same time.

#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace treeform::detail::base {

/// Disjoint sets of the numbers 0 ... size-1. A set's root is its lowest member, so sets and roots
/// do not depend on the order of joins or on threads.
///
/// \source Patwary, Refsnes and Manne, Multi-core Spanning Forest Algorithms using the Disjoint-set
///         Data Structure, IPDPS 2012, for Rem's algorithm with splicing; exchanges instead of
///         locks
class union_find {
  public:
    explicit union_find(std::size_t size) : parent_(size) {
        for_chunks(size, light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i) parent_[i] = static_cast<std::uint32_t>(i);
        });
    }

    /// The root of the set of i. Parents have lower numbers than their children, so the walk ends.
    /// Each step shortens the path; if another thread changed the parent meanwhile, its change is
    /// equally valid.
    [[nodiscard]] std::uint32_t root(std::uint32_t i) {
        for (;;) {
            std::uint32_t up = load(i);
            if (up == i) return i;
            const std::uint32_t further = load(up);
            if (further == up) return up;
            at(i).compare_exchange_weak(up, further, std::memory_order_relaxed);
            i = further;
        }
    }

    /// Joins the sets of i and j. Walks up from both until the parents agree, always from the one
    /// with the higher parent, and links it to the lower parent. A link that this replaces is one
    /// that the walk still has to join. If an exchange fails, another thread changed the link, and
    /// the walk continues from there.
    void join(std::uint32_t i, std::uint32_t j) {
        std::uint32_t above_i = load(i);
        std::uint32_t above_j = load(j);
        while (above_i != above_j) {
            if (above_i < above_j) {
                std::swap(i, j);
                std::swap(above_i, above_j);
            }
            if (at(i).compare_exchange_strong(above_i, above_j, std::memory_order_relaxed)) {
                if (above_i == i) return;  // a root was linked
                i = above_i;
                above_i = load(i);
            }
        }
    }

    /// Returns the root of each number. No other function may be called afterwards.
    [[nodiscard]] buffer<std::uint32_t> take_roots() {
        for_chunks(size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i) {
                const auto number = static_cast<std::uint32_t>(i);
                at(number).store(root(number), std::memory_order_relaxed);
            }
        });
        return std::move(parent_);
    }

    /// Prefetches the memory that the next `root(i)` reads first.
    void prefetch(std::uint32_t i) const { __builtin_prefetch(&parent_[i]); }

    [[nodiscard]] std::size_t size() const { return parent_.size(); }

  private:
    /// Relaxed, since a parent publishes no other data.
    [[nodiscard]] std::atomic_ref<std::uint32_t> at(std::uint32_t i) {
        return std::atomic_ref<std::uint32_t>(parent_[i]);
    }
    [[nodiscard]] std::uint32_t load(std::uint32_t i) {
        return at(i).load(std::memory_order_relaxed);
    }

    buffer<std::uint32_t> parent_;
};

}  // namespace treeform::detail::base
