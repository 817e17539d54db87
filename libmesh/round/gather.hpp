#pragma once
/// \file
/// Lists that are found in parallel.

#include <treeform/tree/parallel.hpp>

#include <atomic>
#include <cstddef>
#include <vector>

namespace treeform::detail::round {

/// `find(i, part)` for 0 <= i < count, in parallel; the parts in order. Of more than `most`, some
/// that are more than that.
template <class T, class Find>
std::vector<T> gather(std::size_t count, std::size_t most, const Find& find) {
    constexpr std::size_t grain = std::size_t{1} << 10;
    std::vector<std::vector<T>> parts(chunk_count(count, grain));
    std::atomic<std::size_t> total{0};
    for_chunks(count, grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        for (std::size_t i = begin; i < end && total <= most; ++i) {
            const std::size_t before = parts[c].size();
            find(i, parts[c]);
            total += parts[c].size() - before;
        }
    });
    std::vector<T> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace treeform::detail::round
