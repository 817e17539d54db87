#pragma once
/// \file
/// Orders in which a nearness search opens nodes.
///
/// An order has a frontier: a container of entries, each with a lower bound `lower`. A search opens
/// the entry that `pop` returns, `push`es its children between `open` and `close`, and ends when
/// `pop` returns false, that is, when no entry with `lower` <= `bound` is left. Answers do not
/// depend on the order.

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace treeform::strategy {

/// Depth first, the children of a node by distance: entries do not move after their node is closed.
struct depth_first {
    template <class Entry, std::size_t Capacity>
    class frontier {
      public:
        explicit frontier(const depth_first& = {}) {}

        void open() { bottom_ = size_; }
        void push(const Entry& entry) {
            std::size_t at = size_++;
            for (; at > bottom_ && stack_[at - 1].lower < entry.lower; --at)
                stack_[at] = stack_[at - 1];
            stack_[at] = entry;
        }
        void close(std::size_t) {}

        template <class Bound>
        bool pop(Entry& entry, const Bound& bound) {
            while (size_ != 0) {
                entry = stack_[--size_];
                if (entry.lower <= bound) return true;
            }
            return false;
        }

      private:
        std::array<Entry, Capacity> stack_;
        std::size_t size_ = 0;
        std::size_t bottom_ = 0;
    };
};

/// A stack whose top k entries are sorted after each node.
/// \source Sajovic, Knez and Korez, tf::tree, section III-D1
struct top_k_sorted {
    /// Number of entries to sort. 0: the paper's choice, the entries pushed from the node plus its
    /// number of children.
    std::size_t k = 0;

    template <class Entry, std::size_t>
    class frontier {
      public:
        frontier() { stack_.reserve(256); }
        explicit frontier(const top_k_sorted& order) : frontier() { k_ = order.k; }

        void open() { bottom_ = stack_.size(); }
        void push(const Entry& entry) { stack_.push_back(entry); }
        /// `children`: number of children of the node, pushed or not.
        void close(std::size_t children) {
            const std::size_t pushed = stack_.size() - bottom_;
            const std::size_t top = std::min(k_ != 0 ? k_ : pushed + children, stack_.size());
            std::sort(stack_.end() - static_cast<std::ptrdiff_t>(top), stack_.end(),
                      [](const Entry& a, const Entry& b) { return a.lower > b.lower; });
        }

        template <class Bound>
        bool pop(Entry& entry, const Bound& bound) {
            while (!stack_.empty()) {
                entry = stack_.back();
                stack_.pop_back();
                if (entry.lower <= bound) return true;
            }
            return false;
        }

      private:
        std::vector<Entry> stack_;
        std::size_t k_ = 0;
        std::size_t bottom_ = 0;
    };
};

/// Best first, by a binary heap: opens the fewest nodes.
/// \source Roussopoulos, Kelley and Vincent, Nearest Neighbor Queries, SIGMOD 1995
struct priority_queue {
    template <class Entry, std::size_t>
    class frontier {
      public:
        explicit frontier(const priority_queue& = {}) { heap_.reserve(256); }

        void open() {}
        void push(const Entry& entry) {
            heap_.push_back(entry);
            std::push_heap(heap_.begin(), heap_.end(), further);
        }
        void close(std::size_t) {}

        template <class Bound>
        bool pop(Entry& entry, const Bound& bound) {
            if (heap_.empty() || !(heap_.front().lower <= bound)) return false;
            std::pop_heap(heap_.begin(), heap_.end(), further);
            entry = heap_.back();
            heap_.pop_back();
            return true;
        }

      private:
        static bool further(const Entry& a, const Entry& b) { return a.lower > b.lower; }
        std::vector<Entry> heap_;
    };
};

}  // namespace treeform::strategy
