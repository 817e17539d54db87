#pragma once
/// \file
/// Converts radii of callers, which are not squared, to the squares that searches compare.

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace treeform::detail {

/// The largest double whose rounded square root is at most `radius`, so that a returned distance
/// equal to the radius counts as within it. It is a few units in the last place above the square of
/// the radius.
/// \pre radius >= 0
[[nodiscard]] inline double squared_limit(double radius) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double square = radius * radius;
    if (square == infinity) return square;
    for (double next = std::nextafter(square, infinity); std::sqrt(next) <= radius;
         next = std::nextafter(next, infinity))
        square = next;
    return square;
}

/// \throws std::invalid_argument unless 0 <= radius
inline void check_radius(const char* function, double radius) {
    if (!(radius >= 0.0))
        throw std::invalid_argument(std::string(function) + ": the radius is negative or NaN");
}

[[nodiscard]] inline double squared_radius(const char* function, double radius) {
    check_radius(function, radius);
    return squared_limit(radius);
}

}  // namespace treeform::detail
