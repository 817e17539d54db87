#pragma once
/// \file
/// Selection that narrows the range by selecting in a sample first.

#include <treeform/tree/detail/partition_around.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace treeform::strategy {

struct floyd_rivest {
    /// Reorders [first, last) so that no element before `nth` is greater than one behind it.
    ///
    /// In a large range, a sample about nth is selected in first, so that the element at nth is a
    /// pivot next to which the wanted one lies in all likelihood.
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
        // nth lies in the sample whatever the rounding.
        const auto begin = std::min(first + static_cast<std::ptrdiff_t>(low), nth);
        const auto end = std::max(first + static_cast<std::ptrdiff_t>(high), nth) + 1;
        partition(begin, nth, end, less);
    }
};

}  // namespace treeform::strategy
