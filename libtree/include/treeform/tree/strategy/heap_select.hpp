#pragma once
/// \file
/// Selection by a heap of the smallest elements seen.

#include <algorithm>
#include <iterator>

namespace treeform::strategy {

struct heap_select {
    /// Reorders [first, last) so that no element before `nth` is greater than one behind it.
    ///
    /// \cost O(n log k) for the k elements up to nth, whatever the order
    /// \source Williams, Algorithm 232: Heapsort, CACM 7 (1964), for the heap
    template <class Iterator, class Less>
    static void partition(Iterator first, Iterator nth, Iterator last, Less less) {
        if (nth == last) return;
        const Iterator end = std::next(nth);  // [first, end) is a heap, its greatest in front
        std::make_heap(first, end, less);
        for (Iterator i = end; i != last; ++i)
            if (less(*i, *first)) {
                std::pop_heap(first, end, less);
                std::iter_swap(nth, i);
                std::push_heap(first, end, less);
            }
        std::iter_swap(first, nth);
    }
};

}  // namespace treeform::strategy
