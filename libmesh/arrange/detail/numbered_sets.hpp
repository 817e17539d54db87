#pragma once
/// \file
/// Disjoint sets as consecutive numbers.

#include <libmesh/detail/union_find.hpp>
#include <libtree/detail/buffer.hpp>
#include <libtree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tf::detail {

struct numbered_sets {
    buffer<std::uint32_t> set_of;       ///< [N] the set of each element
    std::vector<std::uint32_t> lowest;  ///< [S] the lowest element of each set

    [[nodiscard]] std::uint32_t operator[](std::size_t element) const { return set_of[element]; }
    [[nodiscard]] std::size_t count() const { return lowest.size(); }
};

/// The sets, numbered in the order of their lowest elements.
/// \same on any number of threads
[[nodiscard]] inline numbered_sets number_sets(union_find& sets) {
    constexpr std::size_t grain = std::size_t{1} << 14;
    numbered_sets result{buffer<std::uint32_t>(sets.size()), {}};
    buffer<std::uint32_t>& set_of = result.set_of;
    for_chunks(sets.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
            set_of[i] = sets.root(static_cast<std::uint32_t>(i));
    });
    for (std::size_t i = 0; i < sets.size(); ++i) {
        if (set_of[i] != i) {
            set_of[i] = set_of[set_of[i]];  // the root came before and has its number
        } else {
            set_of[i] = static_cast<std::uint32_t>(result.lowest.size());
            result.lowest.push_back(static_cast<std::uint32_t>(i));
        }
    }
    return result;
}

}  // namespace tf::detail
