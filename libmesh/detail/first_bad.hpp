#pragma once
/// \file
/// The first of many elements that something is wrong with.

#include <libtree/parallel.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tf::detail {

/// Lowest i in [0, count) that `bad` holds for, or `count`.
///
/// \cost O(count) calls, in parallel; each chunk stops at its first
/// \same on any number of threads
template <class Bad>
[[nodiscard]] std::size_t first_bad(std::size_t count, const Bad& bad) {
    constexpr std::size_t grain = std::size_t{1} << 14;
    std::vector<std::size_t> first(chunk_count(count, grain), count);
    for_chunks(count, grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        for (std::size_t i = begin; i < end && first[chunk] == count; ++i)
            if (bad(i)) first[chunk] = i;
    });
    return first.empty() ? count : *std::min_element(first.begin(), first.end());
}

}  // namespace tf::detail
