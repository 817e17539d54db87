#pragma once
/// \file
/// Check of a tolerance, and the size of cubes derived from it.

#include <cmath>
#include <stdexcept>
#include <string>

namespace treeform::detail::weld {

/// Number of cube edges in a tolerance, such that all points in a cube are within the tolerance of
/// each other: the diagonal of a cube is less than it (except where rounding makes a denormal width
/// larger). Points within the tolerance are at most two cubes apart along each axis.
inline constexpr double cubes_per_tolerance = 1.7321 * (1.0 + 0x1p-10);

/// \throws std::invalid_argument naming the function `called`
inline void check_tolerance(const char* called, double tolerance) {
    if (!(tolerance >= 0.0) || !std::isfinite(tolerance))
        throw std::invalid_argument(std::string("treeform::") + called +
                                    ": the tolerance must be finite and not negative");
}

}  // namespace treeform::detail::weld
