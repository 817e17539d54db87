#pragma once
/// \file
/// Axis-aligned boxes.

#include <array>
#include <concepts>
#include <cstddef>
#include <limits>

namespace treeform {

/// A closed box [min, max] of D dimensions; empty as constructed (min = +inf, max = -inf), so that
/// the union with it changes nothing and it overlaps nothing.
template <std::floating_point T, std::size_t D>
struct aabb {
    using scalar = T;
    static constexpr std::size_t dimensions = D;

    std::array<T, D> min = filled(std::numeric_limits<T>::infinity());
    std::array<T, D> max = filled(-std::numeric_limits<T>::infinity());

    /// Grows to hold `point`, anything with [], its coordinates rounded to T: a box of float around
    /// points of double may miss them by a rounding. A coordinate that is NaN makes the box one
    /// that holds nothing and that `build` refuses, whatever else is included.
    template <class Point>
    constexpr void include(const Point& point) {
        for (std::size_t i = 0; i < D; ++i)
            widen(i, static_cast<T>(point[i]), static_cast<T>(point[i]));
    }

    constexpr void include(const aabb& other) {
        for (std::size_t i = 0; i < D; ++i) widen(i, other.min[i], other.max[i]);
    }

    [[nodiscard]] constexpr bool empty() const {
        for (std::size_t i = 0; i < D; ++i)
            if (!(min[i] <= max[i])) return true;
        return false;
    }

    friend constexpr bool operator==(const aabb&, const aabb&) = default;

  private:
    /// By value: std::min returns a reference, which becomes a branch nobody can predict.
    constexpr void widen(std::size_t i, T low, T high) {
        min[i] = low < min[i] ? low : min[i];
        const bool higher = (max[i] < high) | (high != high);  // NaN stays
        max[i] = higher ? high : max[i];
    }

    static constexpr std::array<T, D> filled(T value) {
        std::array<T, D> result{};
        result.fill(value);
        return result;
    }
};

/// Whether two closed boxes have a common point; touching counts, empty boxes have none.
template <class T, std::size_t D>
[[nodiscard]] constexpr bool overlaps(const aabb<T, D>& a, const aabb<T, D>& b) {
    for (std::size_t i = 0; i < D; ++i)
        if (!(a.min[i] <= b.max[i] && b.min[i] <= a.max[i])) return false;
    return true;
}

/// The box of the points that two boxes have in common; empty when there are none.
template <class T, std::size_t D>
[[nodiscard]] constexpr aabb<T, D> common_box(const aabb<T, D>& a, const aabb<T, D>& b) {
    if (!overlaps(a, b)) return {};
    aabb<T, D> common;
    for (std::size_t i = 0; i < D; ++i) {
        common.min[i] = a.min[i] < b.min[i] ? b.min[i] : a.min[i];
        common.max[i] = a.max[i] < b.max[i] ? a.max[i] : b.max[i];
    }
    return common;
}

}  // namespace treeform
