#pragma once
/// \file
/// Axis-aligned boxes, and affine maps of the plane and of space.

#include <treeform/tree/detail/export.hpp>

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <type_traits>

namespace treeform {

/// A closed box [min, max] of D dimensions. By default the box is empty (min = +inf, max = -inf):
/// it overlaps nothing, and including it changes nothing. With `min` alone, as in
/// `aabb<double, 3>{{x, y, z}}`, it is the box of that point.
template <std::floating_point T, std::size_t D>
struct aabb {
    using scalar = T;
    static constexpr std::size_t dimensions = D;

    std::array<T, D> min = filled(std::numeric_limits<T>::infinity());
    std::array<T, D> max = point_or_empty(min);

    /// Grows to contain `point`, anything with []. Coordinates are rounded to T, so a box of floats
    /// may miss a point of doubles by a rounding error. A NaN coordinate makes the box empty
    /// permanently; `build` refuses such a box.
    template <class Point>
    constexpr void include(const Point& point) {
        for (std::size_t i = 0; i < D; ++i)
            widen(i, static_cast<T>(point[i]), static_cast<T>(point[i]));
    }

    /// Grows to contain `other`.
    constexpr void include(const aabb& other) {
        for (std::size_t i = 0; i < D; ++i) widen(i, other.min[i], other.max[i]);
    }

    /// Whether the box contains no point.
    [[nodiscard]] constexpr bool empty() const {
        for (std::size_t i = 0; i < D; ++i)
            if (!(min[i] <= max[i])) return true;
        return false;
    }

    friend constexpr bool operator==(const aabb&, const aabb&) = default;

  private:
    /// By value: std::min returns a reference, which compiles to an unpredictable branch.
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

    static constexpr std::array<T, D> point_or_empty(const std::array<T, D>& min) {
        std::array<T, D> max = min;
        for (T& x : max)
            if (x == std::numeric_limits<T>::infinity()) x = -x;
        return max;
    }
};

/// Whether two closed boxes have a common point. Touching counts; an empty box has no points.
template <class T, std::size_t D>
[[nodiscard]] constexpr bool overlaps(const aabb<T, D>& a, const aabb<T, D>& b) {
    for (std::size_t i = 0; i < D; ++i)
        if (!(a.min[i] <= b.max[i] && b.min[i] <= a.max[i])) return false;
    return true;
}

/// The squared distance of a point, anything with [], from a box; 0 inside.
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

namespace detail {
[[nodiscard]] TREEFORM_API std::array<std::array<double, 4>, 3> rotation_rows(
    const std::array<double, 3>& about, double degrees);
}  // namespace detail

/// The affine map that takes a point x to M x + t. Row k of `rows` is [M[k][0] ... M[k][D-1],
/// t[k]]. By default the identity. M may be any matrix: a rotation, a mirror, a shear, even
/// singular.
template <std::size_t D>
struct transform {
    static constexpr std::size_t dimensions = D;
    using row = std::array<double, D + 1>;

    std::array<row, D> rows = unit();

    /// The image of `point`, a copyable type with [] that reads and writes coordinates.
    ///
    /// Coordinate k is ((M[k][0] x[0] + M[k][1] x[1]) + M[k][2] x[2]) + t[k], each product and each
    /// sum rounded to double, unless the compiler may fuse them (`-ffp-contract`). The libraries
    /// are compiled without fusing, so that the image is the same on every machine.
    template <class Point>
    [[nodiscard]] constexpr Point operator()(const Point& point) const {
        Point moved = point;
        for (std::size_t k = 0; k < D; ++k) {
            double sum = rows[k][0] * static_cast<double>(point[0]);
            for (std::size_t j = 1; j < D; ++j) sum += rows[k][j] * static_cast<double>(point[j]);
            moved[k] = static_cast<std::remove_cvref_t<decltype(moved[k])>>(sum + rows[k][D]);
        }
        return moved;
    }

    /// The map that adds `offset`, a list of numbers or anything with [], to every point.
    template <class Vector = std::array<double, D>>
    [[nodiscard]] static constexpr transform translation(const Vector& offset) {
        transform result;
        for (std::size_t k = 0; k < D; ++k) result.rows[k][D] = offset[k];
        return result;
    }

    /// The rotation about an axis through the origin, counterclockwise if the axis points to the
    /// viewer. Quarter turns about a coordinate axis are exact.
    ///
    /// \throws std::invalid_argument if the axis is zero, or it or the angle is not finite
    [[nodiscard]] static transform rotation(const std::array<double, 3>& axis,
                                            double degrees) requires(D == 3) {
        return {detail::rotation_rows(axis, degrees)};
    }

    /// The composition: the map that applies `inner` first, then this map. Entries are rounded.
    [[nodiscard]] constexpr transform after(const transform& inner) const {
        transform result;
        for (std::size_t k = 0; k < D; ++k)
            for (std::size_t j = 0; j <= D; ++j) {
                double sum = j == D ? rows[k][D] : 0.0;
                for (std::size_t i = 0; i < D; ++i) sum += rows[k][i] * inner.rows[i][j];
                result.rows[k][j] = sum;
            }
        return result;
    }

    /// The inverse map: m.inverse().after(m) is the identity, except for rounding. Exact for
    /// translations, permutations of axes and scalings by powers of two.
    ///
    /// \throws std::invalid_argument if the map is singular, by its rounded determinant, or if an
    ///         entry of the result is not finite
    /// \source Cramer's rule
    [[nodiscard]] transform inverse() const requires(D == 2 || D == 3);

    /// Whether the map reverses orientation, like a mirror: its rounded determinant is negative.
    /// Such a map turns a surface inside out, unless its faces are flipped.
    [[nodiscard]] constexpr bool mirrors() const requires(D == 2 || D == 3) {
        if constexpr (D == 2) {
            return rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0] < 0.0;
        } else {
            double determinant = 0.0;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
                determinant += rows[0][k] * (rows[1][i] * rows[2][j] - rows[1][j] * rows[2][i]);
            }
            return determinant < 0.0;
        }
    }

    /// Whether no entry is NaN or infinite.
    [[nodiscard]] bool finite() const {
        for (const row& r : rows)
            for (const double entry : r)
                if (!std::isfinite(entry)) return false;
        return true;
    }

    friend constexpr bool operator==(const transform&, const transform&) = default;

  private:
    static constexpr std::array<row, D> unit() {
        std::array<row, D> result{};
        for (std::size_t k = 0; k < D; ++k) result[k][k] = 1.0;
        return result;
    }
};

namespace detail {

/// As `transform::inverse`, but entries may be infinite or NaN.
template <std::size_t D>
requires(D == 2 || D == 3) [[nodiscard]] transform<D> unchecked_inverse(const transform<D>& by) {
    const auto& m = by.rows;
    transform<D> result;
    double determinant = 0.0;
    if constexpr (D == 2) {
        result.rows = {{{m[1][1], -m[0][1], 0.0}, {-m[1][0], m[0][0], 0.0}}};
        determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    } else {
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                const std::size_t r = (j + 1) % 3, s = (j + 2) % 3;
                const std::size_t c = (i + 1) % 3, d = (i + 2) % 3;
                result.rows[i][j] = m[r][c] * m[s][d] - m[r][d] * m[s][c];
            }
        for (std::size_t k = 0; k < 3; ++k) determinant += m[0][k] * result.rows[k][0];
    }
    for (auto& row : result.rows) {
        double shift = 0.0;
        for (std::size_t k = 0; k < D; ++k) {
            row[k] = row[k] / determinant + 0.0;  // no -0
            shift -= row[k] * m[k][D];
        }
        row[D] = shift + 0.0;
    }
    return result;
}

}  // namespace detail

template <std::size_t D>
transform<D> transform<D>::inverse() const requires(D == 2 || D == 3) {
    const transform result = detail::unchecked_inverse(*this);
    if (!result.finite())
        throw std::invalid_argument("treeform::transform::inverse: the map has no inverse");
    return result;
}

}  // namespace treeform
