#pragma once
/// \file
/// Selection by the standard library (introselect), the default of the paper.

#include <algorithm>

namespace treeform::strategy {

struct nth_element {
    /// Reorders [first, last) so that no element before `nth` is greater than one behind it.
    template <class Iterator, class Less>
    static void partition(Iterator first, Iterator nth, Iterator last, Less less) {
        std::nth_element(first, nth, last, less);
    }
};

}  // namespace treeform::strategy
