#pragma once
/// \file
/// Selection in linear time whatever the order: the median of medians of five as the pivot.

#include <treeform/tree/detail/partition_around.hpp>

#include <iterator>

namespace treeform::strategy {

struct median_of_medians {
    /// Reorders [first, last) so that no element before `nth` is greater than one behind it.
    ///
    /// \cost O(n) in the worst case
    /// \source Blum, Floyd, Pratt, Rivest and Tarjan, Time Bounds for Selection, JCSS 7 (1973)
    template <class Iterator, class Less>
    static void partition(Iterator first, Iterator nth, Iterator last, Less less) {
        if (nth == last) return;
        detail::quickselect(first, nth, last, less, [&](Iterator begin, Iterator, Iterator end) {
            return pivot(begin, end, less);
        });
    }

  private:
    /// Gathers the medians of all groups of five in front and selects theirs.
    template <class Iterator, class Less>
    static Iterator pivot(Iterator first, Iterator last, const Less& less) {
        Iterator medians_end = first;
        for (Iterator group = first; last - group >= 5; group += 5) {
            detail::insertion_sort(group, group + 5, less);
            std::iter_swap(medians_end++, group + 2);
        }
        const Iterator middle = first + (medians_end - first) / 2;
        partition(first, middle, medians_end, less);
        return middle;
    }
};

}  // namespace treeform::strategy
