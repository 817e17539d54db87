#pragma once
/// \file
/// Axis-aligned boxes.

#include <array>
#include <concepts>
#include <cstddef>
#include <limits>

namespace treeform {

/// A closed box [min, max] of D dimensions. A new one is empty (min = +inf, max = -inf): it
/// overlaps nothing, and including it changes nothing.
template <std::floating_point T, std::size_t D>
struct aabb {
    using scalar = T;
    static constexpr std::size_t dimensions = D;

    std::array<T, D> min = filled(std::numeric_limits<T>::infinity());
    std::array<T, D> max = filled(-std::numeric_limits<T>::infinity());

    /// Grows to hold `point`, anything with []. Coordinates are rounded to T, so a box of float may
    /// miss a point of double by a rounding. A NaN coordinate makes the box empty for good; `build`
    /// refuses such a box.
    template <class Point>
    constexpr void include(const Point& point) {
        for (std::size_t i = 0; i < D; ++i)
            widen(i, static_cast<T>(point[i]), static_cast<T>(point[i]));
    }

    /// Grows to hold `other`.
    constexpr void include(const aabb& other) {
        for (std::size_t i = 0; i < D; ++i) widen(i, other.min[i], other.max[i]);
    }

    /// Whether the box holds no point.
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

/// Whether two closed boxes have a common point. Touching counts; an empty box has no points.
template <class T, std::size_t D>
[[nodiscard]] constexpr bool overlaps(const aabb<T, D>& a, const aabb<T, D>& b) {
    for (std::size_t i = 0; i < D; ++i)
        if (!(a.min[i] <= b.max[i] && b.min[i] <= a.max[i])) return false;
    return true;
}

/// The squared distance of a point, anything with [], from a box; 0 in it.
template <class T, std::size_t D, class Point>
[[nodiscard]] constexpr double squared_distance(const aabb<T, D>& box, const Point& point) {
    double sum = 0.0;
    for (std::size_t i = 0; i < D; ++i) {
        const double below = box.min[i] - point[i], above = point[i] - box.max[i];
        const double away = below > 0.0 ? below : above > 0.0 ? above : 0.0;
        sum += away * away;
    }
    return sum;
}

/// The intersection of two boxes; empty when they have no common point.
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
