#pragma once
/// \file
/// Points as the predicates see them: two or three doubles, nothing else.

#include <cstddef>

namespace treeform {

/// A point or vector of the plane.
struct point2 {
    double x = 0.0;
    double y = 0.0;

    [[nodiscard]] constexpr double operator[](std::size_t axis) const { return axis == 0 ? x : y; }
    [[nodiscard]] constexpr double& operator[](std::size_t axis) { return axis == 0 ? x : y; }
    friend constexpr bool operator==(const point2&, const point2&) = default;
};

/// A point or vector of space. Equality is that of doubles: -0 equals +0.
struct point3 {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;

    [[nodiscard]] constexpr double operator[](std::size_t axis) const {
        return axis == 0 ? x : axis == 1 ? y : z;
    }
    [[nodiscard]] constexpr double& operator[](std::size_t axis) {
        return axis == 0 ? x : axis == 1 ? y : z;
    }
    friend constexpr bool operator==(const point3&, const point3&) = default;
};

}  // namespace treeform
