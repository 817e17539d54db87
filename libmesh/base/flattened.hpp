#pragma once
/// \file
/// Concatenates the results of the chunks of a loop.

#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace treeform::detail::base {

/// The elements of `parts`, one part after the other. Empties the parts.
/// \same on any number of threads
template <class T>
[[nodiscard]] std::vector<T> flattened(std::vector<std::vector<T>>&& parts) {
    std::vector<std::size_t> first(parts.size() + 1, 0);
    for (std::size_t i = 0; i < parts.size(); ++i) first[i + 1] = first[i] + parts[i].size();
    std::vector<T> all(first.back());
    const std::size_t grain = 1 + parts.size() * light_grain / (first.back() + 1);
    for_chunks(parts.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            std::copy(parts[i].begin(), parts[i].end(), all.data() + first[i]);
            parts[i] = {};
        }
    });
    return all;
}

}  // namespace treeform::detail::base
