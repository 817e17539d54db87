#pragma once
/// \file
/// Sorts pairs of faces.

#include <treeform/mesh/self_intersections.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace treeform::detail::intersect {

/// Sorts `pairs`, no two of which have the same faces, ascending by (a, b): a radix sort, from the
/// lowest digit of b to the highest used digit of a.
///
/// \cost O(pairs) time; temporary memory of the size of `pairs`
inline void sort_pairs(std::vector<face_pair>& pairs) {
    constexpr unsigned digit_bits = 11;
    constexpr std::size_t digits = std::size_t{1} << digit_bits;
    if (pairs.size() < 256) {  // break-even
        std::sort(pairs.begin(), pairs.end());
        return;
    }
    std::vector<face_pair> other(pairs.size());
    const auto sort_by = [&](std::uint32_t face_pair::*face) {
        std::uint32_t used = 0;
        for (const face_pair& pair : pairs) used |= pair.*face;
        for (unsigned shift = 0; shift < 32 && used >> shift != 0; shift += digit_bits) {
            const auto digit = [&](const face_pair& pair) {
                return (pair.*face >> shift) & (digits - 1);
            };
            std::array<std::size_t, digits> next{};
            for (const face_pair& pair : pairs) ++next[digit(pair)];
            std::size_t begin = 0;
            for (std::size_t& n : next) begin += std::exchange(n, begin);
            for (const face_pair& pair : pairs) other[next[digit(pair)]++] = pair;
            pairs.swap(other);
        }
    };
    sort_by(&face_pair::b);
    sort_by(&face_pair::a);
}

}  // namespace treeform::detail::intersect
