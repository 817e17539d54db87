#pragma once
/// \file
/// Finds the first invalid element.

#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace treeform::detail::base {

/// The lowest i in [0, count) for which `bad(i)` is true, or `count`.
///
/// \cost O(count) calls, in parallel; all of a chunk are tested, since usually none is bad
/// \same on any number of threads
template <class Bad>
[[nodiscard]] std::size_t first_bad(std::size_t count, const Bad& bad,
                                    std::size_t grain = light_grain) {
    std::vector<std::size_t> first(chunk_count(count, grain), count);
    for_chunks(count, grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        bool any = false;  // without a branch in the loop
        for (std::size_t i = begin; i < end; ++i) any |= bad(i);
        if (!any) return;
        first[chunk] = begin;
        while (!bad(first[chunk])) ++first[chunk];
    });
    return first.empty() ? count : *std::min_element(first.begin(), first.end());
}

}  // namespace treeform::detail::base
