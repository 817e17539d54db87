#pragma once
/// \file
/// Selection algorithms of the paper that choose their pivot as a median: slower in `build` than
/// the default selection.

#include <libtree/paper/partition_around.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>

namespace treeform::strategy {

struct median_of_3_random {
    /// Reorders [first, last) so that no element before `nth` is greater than one after it. The
    /// random positions are the same in every call with the same number of elements.
    ///
    /// \cost O(n) expected; O(n^2) for an adversarial order
    /// \source Hoare, Algorithm 65: Find, CACM 4 (1961)
    template <class Iterator, class Less>
    static void partition(Iterator first, Iterator nth, Iterator last, Less less) {
        if (nth == last) return;
        auto state = static_cast<std::uint64_t>(last - first);
        const auto random_place = [&state](Iterator begin, Iterator end) {
            // splitmix64 (Steele, Lea and Flood, OOPSLA 2014)
            std::uint64_t z = state += 0x9E3779B97F4A7C15U;
            z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
            z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
            z ^= z >> 31;
            return begin + static_cast<std::ptrdiff_t>(z % static_cast<std::uint64_t>(end - begin));
        };
        detail::quickselect(first, nth, last, less, [&](Iterator begin, Iterator, Iterator end) {
            return detail::median_of_three(random_place(begin, end), random_place(begin, end),
                                           random_place(begin, end), less);
        });
    }
};

struct median_of_medians {
    /// Reorders [first, last) so that no element before `nth` is greater than one after it.
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
    /// Moves the medians of all groups of five to the front, and selects their median.
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

struct median_of_ninthers {
    /// Reorders [first, last) so that no element before `nth` is greater than one after it.
    ///
    /// A ninther is the median of the medians of three triples. The pivot is the median of the
    /// ninthers of groups spread over the range; the larger the range, the fewer groups for its
    /// size, down to one element in 16.
    ///
    /// \cost O(n) in the worst case: the pivot is above and below a fixed share of the elements
    /// \source Alexandrescu, Fast Deterministic Selection, arXiv 1606.00484 (2016)
    template <class Iterator, class Less>
    static void partition(Iterator first, Iterator nth, Iterator last, Less less) {
        if (nth == last) return;
        detail::quickselect(first, nth, last, less, [&](Iterator begin, Iterator, Iterator end) {
            return pivot(begin, end, less);
        });
    }

  private:
    /// Moves the ninthers to the front, and selects their median. Group g takes one element from
    /// each ninth of the range.
    template <class Iterator, class Less>
    static Iterator pivot(Iterator first, Iterator last, const Less& less) {
        const std::ptrdiff_t ninth = (last - first) / 9;
        if (ninth == 0) return first + (last - first) / 2;
        const std::ptrdiff_t share = last - first <= 1024 ? 1 : last - first <= 131072 ? 4 : 16;
        const std::ptrdiff_t groups = std::max<std::ptrdiff_t>(ninth / share, 1);
        // A swap into the front takes only from this group's own places or from the front ninth
        // at places not yet used, so every ninther is one of a group of nine different elements.
        for (std::ptrdiff_t g = 0; g < groups; ++g) {
            const auto triple = [&](std::ptrdiff_t part) {
                return detail::median_of_three(first + (part * ninth + g),
                                               first + ((part + 1) * ninth + g),
                                               first + ((part + 2) * ninth + g), less);
            };
            const Iterator ninther = detail::median_of_three(triple(0), triple(3), triple(6), less);
            std::iter_swap(first + g, ninther);
        }
        const Iterator middle = first + groups / 2;
        partition(first, middle, first + groups, less);
        return middle;
    }
};

}  // namespace treeform::strategy
