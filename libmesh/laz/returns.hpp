#pragma once
/// \file
/// Contexts from the return number of a point and the number of returns of its pulse.
///
/// \source LASzip for LAS 1.4, Specification Document: the tables of return maps and levels

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

namespace treeform::detail::laz {

/// For up to 7 returns: up to four returns, each valid combination has its own number.
[[nodiscard]] inline unsigned return_map(unsigned returns, unsigned number) {
    static constexpr std::array<std::array<std::uint8_t, 8>, 8> map{{
        {15, 14, 13, 12, 11, 10, 9, 8},
        {14, 0, 1, 3, 6, 10, 10, 9},
        {13, 1, 2, 4, 7, 11, 11, 10},
        {12, 3, 4, 5, 8, 12, 12, 11},
        {11, 6, 7, 8, 9, 13, 13, 12},
        {10, 10, 11, 12, 13, 14, 14, 13},
        {9, 10, 11, 12, 13, 14, 15, 14},
        {8, 9, 10, 11, 12, 13, 14, 15},
    }};
    return map[returns][number];
}

/// For up to 15 returns: six contexts.
[[nodiscard]] inline unsigned return_map_of_six(unsigned returns, unsigned number) {
    static constexpr std::array<std::array<std::uint8_t, 16>, 16> map{{
        {0, 1, 2, 3, 4, 5, 3, 4, 4, 5, 5, 5, 5, 5, 5, 5},
        {1, 0, 1, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3},
        {2, 1, 2, 4, 4, 4, 4, 4, 4, 4, 4, 3, 3, 3, 3, 3},
        {3, 3, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
        {4, 3, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
        {5, 3, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
        {3, 3, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4},
        {4, 3, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4},
        {4, 3, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4},
        {5, 3, 4, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4},
        {5, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4},
        {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 4, 4, 4},
        {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4, 4},
        {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4},
        {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5},
        {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5},
    }};
    return map[returns][number];
}

/// The distance of a return to the last one of its pulse, at most 7.
[[nodiscard]] inline unsigned return_level(unsigned returns, unsigned number) {
    return std::min(returns > number ? returns - number : number - returns, 7u);
}

}  // namespace treeform::detail::laz
