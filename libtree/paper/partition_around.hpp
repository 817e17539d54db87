#pragma once
/// \file
/// The partition step of quickselect algorithms.

#include <cstddef>
#include <iterator>
#include <utility>

namespace treeform::detail {

/// Moves the pivot to its sorted position, and returns it: no element before it is greater, no
/// element after it is less. Both scans stop at elements equal to the pivot, so that a range of
/// equal elements is cut in the middle and selection stays linear on it.
///
/// \pre  first <= pivot < last
/// \cost last - first comparisons plus a constant
template <class Iterator, class Less>
Iterator partition_around(Iterator first, Iterator pivot, Iterator last, const Less& less) {
    std::iter_swap(first, pivot);
    Iterator low = first;
    Iterator high = last;
    for (;;) {
        do ++low;
        while (low != high && less(*low, *first));
        do --high;
        while (less(*first, *high));
        if (!(low < high)) break;
        std::iter_swap(low, high);
    }
    std::iter_swap(first, high);
    return high;
}

/// The position of the median of three elements.
template <class Iterator, class Less>
Iterator median_of_three(Iterator a, Iterator b, Iterator c, const Less& less) {
    if (less(*b, *a)) std::swap(a, b);
    if (less(*c, *b)) return less(*c, *a) ? a : c;
    return b;
}

/// Sorts a short range by insertion.
template <class Iterator, class Less>
void insertion_sort(Iterator first, Iterator last, const Less& less) {
    for (Iterator i = first; i != last; ++i) {
        auto value = std::move(*i);
        Iterator hole = i;
        for (; hole != first && less(value, *std::prev(hole)); --hole)
            *hole = std::move(*std::prev(hole));
        *hole = std::move(value);
    }
}

/// Quickselect with a pivot rule `choose(first, nth, last)`; short ranges are sorted.
template <class Iterator, class Less, class Choose>
void quickselect(Iterator first, Iterator nth, Iterator last, const Less& less,
                 const Choose& choose) {
    constexpr std::ptrdiff_t short_range = 16;
    while (last - first > short_range) {
        const Iterator cut = partition_around(first, choose(first, nth, last), last, less);
        if (cut == nth) return;
        if (nth < cut)
            last = cut;
        else
            first = cut + 1;
    }
    insertion_sort(first, last, less);
}

}  // namespace treeform::detail
