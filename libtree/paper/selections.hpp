#pragma once
/// \file
/// Selection algorithms to compare with that of `build` (libtree/build/split.cpp).

#include <libtree/paper/partition_around.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace treeform::strategy {

/// `std::nth_element`.
struct nth_element {
    /// Reorders [first, last) so that no element before `nth` is greater than one after it.
    template <class Iterator, class Less>
    static void partition(Iterator first, Iterator nth, Iterator last, Less less) {
        std::nth_element(first, nth, last, less);
    }
};

/// Selection by Floyd and Rivest.
struct floyd_rivest {
    /// Reorders [first, last) so that no element before `nth` is greater than one after it.
    ///
    /// In a large range, it first selects in a sample around nth. So the element at nth becomes a
    /// pivot that is very probably close to the result.
    ///
    /// \cost n + min(k, n - k) + O(sqrt(n)) comparisons expected
    /// \source Floyd and Rivest, Algorithm 489: SELECT, CACM 18 (1975)
    template <class Iterator, class Less>
    static void partition(Iterator first, Iterator nth, Iterator last, Less less) {
        if (nth == last) return;
        detail::quickselect(first, nth, last, less, [&](Iterator begin, Iterator at, Iterator end) {
            if (end - begin > 600) select_in_sample(begin, at, end, less);
            return at;
        });
    }

  private:
    template <class Iterator, class Less>
    static void select_in_sample(Iterator first, Iterator nth, Iterator last, const Less& less) {
        const auto n = static_cast<double>(last - first);
        const auto k = static_cast<double>(nth - first);
        const double log_n = std::log(n);
        const double size = 0.5 * std::exp(2.0 * log_n / 3.0);
        const double spread =
            0.5 * std::sqrt(log_n * size * (n - size) / n) * (k < n / 2.0 ? -1.0 : 1.0);
        const double low = std::max(0.0, k - k * size / n + spread);
        const double high = std::min(n - 1.0, k + (n - k) * size / n + spread);
        // nth lies in the sample for any rounding.
        const auto begin = std::min(first + static_cast<std::ptrdiff_t>(low), nth);
        const auto end = std::max(first + static_cast<std::ptrdiff_t>(high), nth) + 1;
        partition(begin, nth, end, less);
    }
};

/// Selection by a heap.
struct heap_select {
    /// Reorders [first, last) so that no element before `nth` is greater than one after it.
    ///
    /// \cost O(n log k) for the k elements up to nth, for any order
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

/// Pattern-defeating quickselect.
struct pdq_select {
    /// Reorders [first, last) so that no element before `nth` is greater than one after it.
    ///
    /// The pivot is the median of three, in large ranges of three medians of three. After a cut
    /// that leaves less than an eighth on one side, a few swaps break up the pattern; after log2(n)
    /// such cuts, a heap finishes the selection.
    ///
    /// \cost O(n) expected, O(n log n) in the worst case
    /// \source Peters, Pattern-defeating Quicksort, arXiv 2106.05123 (2021)
    template <class Iterator, class Less>
    static void partition(Iterator first, Iterator nth, Iterator last, Less less) {
        if (nth == last) return;
        auto luck = std::bit_width(static_cast<std::size_t>(last - first));
        while (last - first > 24) {
            const std::ptrdiff_t size = last - first;
            const Iterator cut =
                detail::partition_around(first, pivot(first, last, less), last, less);
            if (cut == nth) return;
            if (cut - first < size / 8 || last - cut - 1 < size / 8) {
                if (--luck == 0) return heap_select::partition(first, nth, last, less);
                break_pattern(first, cut);
                break_pattern(std::next(cut), last);
            }
            if (nth < cut)
                last = cut;
            else
                first = std::next(cut);
        }
        detail::insertion_sort(first, last, less);
    }

  private:
    template <class Iterator, class Less>
    static Iterator pivot(Iterator first, Iterator last, const Less& less) {
        const std::ptrdiff_t size = last - first;
        const Iterator middle = first + size / 2;
        const auto median = [&](std::ptrdiff_t i) {
            return detail::median_of_three(first + i, middle + (i - 1), last - (i + 1), less);
        };
        if (size <= 128) return median(1);
        return detail::median_of_three(median(1), median(2), median(3), less);
    }

    /// Swaps a few elements that are a quarter of the range apart.
    template <class Iterator>
    static void break_pattern(Iterator first, Iterator last) {
        const std::ptrdiff_t size = last - first;
        if (size < 24) return;
        std::iter_swap(first, first + size / 4);
        std::iter_swap(last - 1, last - size / 4);
        if (size > 128) {
            std::iter_swap(first + 1, first + (size / 4 + 1));
            std::iter_swap(first + 2, first + (size / 4 + 2));
            std::iter_swap(last - 2, last - (size / 4 + 1));
            std::iter_swap(last - 3, last - (size / 4 + 2));
        }
    }
};

}  // namespace treeform::strategy
