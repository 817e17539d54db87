#pragma once
/// \file
/// Parallel prefix sums.

#include <libmesh/base/resize_all.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <vector>

namespace treeform::detail::base {

/// [count + 1] The sums of `size_of(j)` for all j < i. `size_of` is called twice.
/// \same on any number of threads
template <class SizeOf>
[[nodiscard]] std::vector<std::size_t> running_sums(std::size_t count, const SizeOf& size_of) {
    std::vector<std::size_t> first(chunk_count(count, light_grain) + 1, 0);
    for_chunks(count, light_grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        for (std::size_t i = begin; i < end; ++i) first[chunk + 1] += size_of(i);
    });
    for (std::size_t c = 1; c < first.size(); ++c) first[c] += first[c - 1];
    std::vector<std::size_t> sums;
    resize_all(count + 1, sums);
    for_chunks(count, light_grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        std::size_t sum = first[chunk];
        for (std::size_t i = begin; i < end; ++i) {
            sums[i] = sum;
            sum += size_of(i);
        }
    });
    sums[count] = first.back();
    return sums;
}

}  // namespace treeform::detail::base
