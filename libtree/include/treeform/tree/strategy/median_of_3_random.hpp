#pragma once
/// \file
/// Quickselect about the median of three random elements.

#include <treeform/tree/detail/partition_around.hpp>

#include <cstddef>
#include <cstdint>

namespace treeform::strategy {

struct median_of_3_random {
    /// Reorders [first, last) so that no element before `nth` is greater than one behind it. The
    /// random places are the same in every call on as many elements.
    ///
    /// \cost O(n) expected; O(n^2) for an order made against these places
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

}  // namespace treeform::strategy
