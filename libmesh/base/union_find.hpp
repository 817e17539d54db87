#pragma once
/// \file
/// Disjoint sets that any number of threads may join at the same time.

#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace treeform::detail::base {

/// Sets of the numbers 0 .. size-1. A set's root is its lowest member, so that the sets and their
/// roots depend on what was joined, not on the order or the threads that did it.
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

    /// Parents have lower numbers than their children, so every walk ends. Each step shortens the
    /// way; when another thread has changed the parent meanwhile, its change is as good.
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

    /// Walks up from both until the parents agree, always from the higher parent, and hangs what it
    /// leaves behind below the lower one. Two sets are then one: what was linked stays linked, or
    /// is what this walk still has to link. An exchange that fails met another thread's link, from
    /// which the walk goes on.
    void join(std::uint32_t i, std::uint32_t j) {
        std::uint32_t above_i = load(i);
        std::uint32_t above_j = load(j);
        while (above_i != above_j) {
            if (above_i < above_j) {
                std::swap(i, j);
                std::swap(above_i, above_j);
            }
            if (at(i).compare_exchange_strong(above_i, above_j, std::memory_order_relaxed)) {
                if (above_i == i) return;  // a root has been hung up
                i = above_i;
                above_i = load(i);
            }
        }
    }

    /// The root of each number. \post nothing can be asked any more
    [[nodiscard]] buffer<std::uint32_t> take_roots() {
        for_chunks(size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i) {
                const auto number = static_cast<std::uint32_t>(i);
                at(number).store(root(number), std::memory_order_relaxed);
            }
        });
        return std::move(parent_);
    }

    /// Asks memory for what the next `root(i)` reads first.
    void prefetch(std::uint32_t i) const { __builtin_prefetch(&parent_[i]); }

    [[nodiscard]] std::size_t size() const { return parent_.size(); }

  private:
    /// Relaxed: a parent is a number, and publishes nothing else.
    [[nodiscard]] std::atomic_ref<std::uint32_t> at(std::uint32_t i) {
        return std::atomic_ref<std::uint32_t>(parent_[i]);
    }
    [[nodiscard]] std::uint32_t load(std::uint32_t i) {
        return at(i).load(std::memory_order_relaxed);
    }

    buffer<std::uint32_t> parent_;
};

}  // namespace treeform::detail::base
