#pragma once
/// \file
/// Disjoint sets as consecutive numbers.

#include <libmesh/base/union_find.hpp>
#include <treeform/tree/detail/buffer.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail::arrange {

struct numbered_sets {
    buffer<std::uint32_t> set_of;       ///< [N] the set of each element
    std::vector<std::uint32_t> lowest;  ///< [S] the lowest element of each set

    [[nodiscard]] std::uint32_t operator[](std::size_t element) const { return set_of[element]; }
    [[nodiscard]] std::size_t count() const { return lowest.size(); }
};

/// The sets, numbered in the order of their lowest elements. Reuses the memory of `sets`.
/// \same on any number of threads
[[nodiscard]] inline numbered_sets number_sets(base::union_find sets) {
    numbered_sets result{sets.take_roots(), {}};
    buffer<std::uint32_t>& set_of = result.set_of;
    for (std::size_t i = 0; i < set_of.size(); ++i) {
        if (set_of[i] != i) {
            set_of[i] = set_of[set_of[i]];  // the root came before and has its number
        } else {
            set_of[i] = static_cast<std::uint32_t>(result.lowest.size());
            result.lowest.push_back(static_cast<std::uint32_t>(i));
        }
    }
    return result;
}

}  // namespace treeform::detail::arrange
