#pragma once
/// \file
/// How near is next to each other.

#include <treeform/mesh/mesh.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace treeform::detail::round {

/// The share 2^-bits of the largest coordinate, rounded up to a power of two.
/// \pre coordinates are finite \cost O(V)
[[nodiscard]] inline double reach_of_bits(points_view points, int bits) {
    double largest = 0.0;
    for (const point3& p : points)
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    int exponent = 0;
    std::frexp(largest, &exponent);
    return std::max(std::ldexp(1.0, exponent - bits), std::numeric_limits<double>::min());
}

}  // namespace treeform::detail::round
