#pragma once
/// \file
/// The order in which a nearness search of the paper opens nodes; see query/node_orders.hpp.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace treeform::strategy {

/// A stack of which the top k entries are sorted after each node.
/// \source Sajovic, Knez and Korez, tf::tree, section III-D1
struct top_k_sorted {
    /// Entries to sort; 0 stands for the paper's choice, those pushed from the node and as many
    /// more as it has children.
    std::size_t k = 0;

    template <class Entry, std::size_t>
    class frontier {
      public:
        explicit frontier(const top_k_sorted& strategy) : k_(strategy.k) { stack_.reserve(256); }

        void open() { bottom_ = stack_.size(); }
        void push(const Entry& entry) { stack_.push_back(entry); }
        /// `children`: how many the node has, pushed or not.
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
        std::size_t k_;
        std::size_t bottom_ = 0;
    };
};

}  // namespace treeform::strategy
