#pragma once
/// \file
/// Maps boxes back into the frame of a transformed tree, by the inverse of its transform.

#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/frame_map.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace treeform::detail {

/// Bounds of the magnitudes of a tree's coordinates, by axis; infinite if the tree has no bound.
template <std::size_t D>
std::array<double, D> reach_of(const tree<D>& t) {
    const wide_node<D>& root = t.level(0)[0];
    std::array<double, D> reach;
    for (std::size_t k = 0; k < D; ++k) {
        const double low = *std::min_element(root.min[k], root.min[k] + 8);
        const double high = *std::max_element(root.max[k], root.max[k] + 8);
        reach[k] = std::abs(t.frame().origin[k]) +
                   std::max(std::abs(low), std::abs(high)) / t.frame().scale;
    }
    return reach;
}

/// The map of frame `from` into that of `moved` which takes a box that contains by(x), rounded to
/// double, to a box that contains x, for all x in `moved`. None where it would not help: for a map
/// that is singular or nearly so, or axis-aligned, and at the ends of the range of double.
///
/// With the computed inverse G, the residual R = G by - 1 and the rounding e of by(x), G by(x) = x
/// + R x + G e: of the linear part G L and the shifts, products and sums are off by less than 2^-50
/// of their magnitudes, and so is by(x); `frame_map` covers the rest. The bounds are computed with
/// few roundings, and doubled.
template <std::size_t D>
std::optional<frame_map<D>> map_back(const tree_frame<D>& from, const transform<D>& by,
                                     const tree<D>& moved) {
    constexpr double rounding = 0x1p-50, tiny = 0x1p-300, huge = 0x1p300;
    const transform<D> back = unchecked_inverse(by);
    const std::array<double, D> reach = reach_of(moved);
    bool turns = false, sensible = back.finite();
    std::array<double, D> moved_by{};  // sum of magnitudes of the terms of by(x)
    for (std::size_t k = 0; k < D; ++k) {
        moved_by[k] = std::abs(by.rows[k][D]);
        for (std::size_t j = 0; j < D; ++j) {
            moved_by[k] += std::abs(by.rows[k][j]) * reach[j];
            turns |= j != k && by.rows[k][j] != 0.0;
            sensible &= std::abs(by.rows[k][j]) < 0x1p100 && std::abs(back.rows[k][j]) < 0x1p100;
        }
        sensible &= moved_by[k] > tiny && moved_by[k] < huge && reach[k] < huge;
    }
    if (!turns || !sensible) return std::nullopt;

    frame_map<D> map = map_into(from, back, moved.frame());
    for (std::size_t k = 0; k < D; ++k) {
        double off = 0.0;
        for (std::size_t j = 0; j <= D; ++j) {  // column D: the shifts
            double residual = j == k ? -1.0 : 0.0, magnitude = 1.0;
            if (j == D) residual = back.rows[k][D], magnitude = std::abs(residual);
            for (std::size_t i = 0; i < D; ++i) {
                const double part = back.rows[k][i] * by.rows[i][j];
                residual += part;
                magnitude += std::abs(part);
            }
            off += (std::abs(residual) + rounding * magnitude) * (j == D ? 1.0 : reach[j]);
        }
        for (std::size_t i = 0; i < D; ++i)
            off += std::abs(back.rows[k][i]) * rounding * moved_by[i];
        map.slack_offset[k] += float_or_infinity(2.0 * off * moved.frame().scale);
    }
    return map;
}

}  // namespace treeform::detail
