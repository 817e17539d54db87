#pragma once
/// \file
/// Parallel sorting.

#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::base {

/// The number of elements of `a` among the first `count` elements of the merge of `a` and `b`; of
/// equal elements, those of `a` come first.
template <class T, class Less>
[[nodiscard]] std::size_t taken_of_first(std::span<const T> a, std::span<const T> b,
                                         std::size_t count, const Less& less) {
    std::size_t low = count > b.size() ? count - b.size() : 0, high = std::min(count, a.size());
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        if (less(b[count - middle - 1], a[middle]))
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

/// Sorts by `less`: blocks by `std::sort`, then merges them. The order of elements that compare
/// equal depends on the input alone.
///
/// \cost O(N log N); memory of N elements if there are more than a few thousand
/// \same on any number of threads
template <class T, class Less = std::less<>>
void parallel_sort(std::vector<T>& elements, const Less& less = {}) {
    constexpr std::size_t block = std::size_t{1} << 10;
    const std::size_t count = elements.size();
    if (count <= 2 * block) return std::sort(elements.begin(), elements.end(), less);
    for_chunks(count, block, [&](std::size_t begin, std::size_t end, std::size_t) {
        std::sort(elements.data() + begin, elements.data() + end, less);
    });
    buffer<T> second(count);
    T *from = elements.data(), *to = second.data();
    for (std::size_t width = block; width < count; width *= 2, std::swap(from, to))
        for_chunks(count, block, [&](std::size_t begin, std::size_t end, std::size_t) {
            const std::size_t first = begin / (2 * width) * (2 * width);
            const std::size_t middle = std::min(first + width, count);
            const std::span<const T> a(from + first, from + middle),
                b(from + middle, from + std::min(first + 2 * width, count));
            const std::size_t i = taken_of_first(a, b, begin - first, less),
                              last_i = taken_of_first(a, b, end - first, less);
            std::merge(a.data() + i, a.data() + last_i, b.data() + (begin - first - i),
                       b.data() + (end - first - last_i), to + begin, less);
        });
    if (from == elements.data()) return;
    for_chunks(count, light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        std::copy(from + begin, from + end, to + begin);
    });
}

}  // namespace treeform::detail::base
