#pragma once
/// \file
/// Parallel stable compaction: keeps the elements that satisfy a predicate, in order.

#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <vector>

namespace treeform::detail::base {

/// Calls `resize(n)` for the number n of i in [0, count) with `keep(i)`, then `write(i, place)` for
/// each of these i, where `place` is its rank among them. `keep` is called twice for each i;
/// `write(i, ...)` may change `keep(i)`.
/// \same on any number of threads
template <class Keep, class Resize, class Write>
void compact(std::size_t count, const Keep& keep, const Resize& resize, const Write& write) {
    constexpr std::size_t grain = std::size_t{1} << 11;
    std::vector<std::size_t> first(chunk_count(count, grain) + 1, 0);
    for_chunks(count, grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        std::size_t kept = 0;
        for (std::size_t i = begin; i < end; ++i) kept += keep(i) ? 1 : 0;
        first[chunk + 1] = kept;
    });
    for (std::size_t c = 1; c < first.size(); ++c) first[c] += first[c - 1];
    resize(first.back());
    for_chunks(count, grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        std::size_t place = first[chunk];
        for (std::size_t i = begin; i < end; ++i)
            if (keep(i)) write(i, place++);
    });
}

}  // namespace treeform::detail::base
