#pragma once
/// \file
/// Converts boxes from the frame of a tree to space, and back.

#include <treeform/tree/aabb.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>

namespace treeform::detail {

/// A box in space that contains box `slot` of `node`. Errors: the sum with the origin at most 2^-53
/// of itself, the subtraction of the margin as much, and scaling less than 1e-307.
template <std::size_t D>
[[nodiscard]] aabb<double, D> box_in_space(const tree_frame<D>& frame, const wide_node<D>& node,
                                           std::size_t slot) {
    constexpr double largest = std::numeric_limits<double>::max();
    // A side that the build clamped inward only means that the coordinate is at least that far out,
    // or differs from the origin by more than the largest double.
    const auto difference = [&](float side) { return static_cast<double>(side) / frame.scale; };
    const auto outward = [](double x) { return 0x1p-51 * std::abs(x) + 1e-306; };
    aabb<double, D> box;
    for (std::size_t k = 0; k < D; ++k) {
        const double low = std::min(difference(node.min[k][slot]), largest) + frame.origin[k];
        const double high = std::max(difference(node.max[k][slot]), -largest) + frame.origin[k];
        box.min[k] = std::min(low, largest) - outward(std::min(low, largest));
        box.max[k] = std::max(high, -largest) + outward(std::max(high, -largest));
    }
    return box;
}

/// `box` in a frame, rounded outward. The relative error of the difference is 2^-53, that of the
/// nearest float 2^-24 (below the least normal float, an absolute error of less than 1.2e-38); the
/// margin 1.2e-7 > 2^-23 covers both and the rounding of the sum. A coordinate beyond the range of
/// float is moved outward to infinity; inward it stays at the end of the range, to which the build
/// also clamps.
template <std::size_t D, std::floating_point T>
[[nodiscard]] aabb<float, D> box_in_frame(const tree_frame<D>& frame, const aabb<T, D>& box) {
    const auto nearest = [&](double x, std::size_t k) {
        constexpr double limit = std::numeric_limits<float>::max();
        return static_cast<float>(std::clamp((x - frame.origin[k]) * frame.scale, -limit, limit));
    };
    const auto margin = [](float f) { return std::abs(f) * 1.2e-7F + 1e-37F; };
    aabb<float, D> rounded;
    for (std::size_t k = 0; k < D; ++k) {
        const float low = nearest(static_cast<double>(box.min[k]), k);
        const float high = nearest(static_cast<double>(box.max[k]), k);
        rounded.min[k] = low - margin(low);
        rounded.max[k] = high + margin(high);
    }
    return rounded;
}

/// A finite box in space that contains all primitives of `tree`; empty if there are none.
template <std::size_t D>
[[nodiscard]] aabb<double, D> box_of_root(const tree<D>& tree) {
    constexpr double largest = std::numeric_limits<double>::max();
    aabb<double, D> box;
    if (tree.empty()) return box;
    const wide_node<D>& root = tree.level(0)[0];
    for (std::size_t slot = 0; slot < tree.child_count(0, 0); ++slot)
        if (root.min[0][slot] <= root.max[0][slot])  // else all below were removed
            box.include(box_in_space(tree.frame(), root, slot));
    for (std::size_t k = 0; k < D && !box.empty(); ++k) {
        box.min[k] = std::max(box.min[k], -largest);
        box.max[k] = std::min(box.max[k], largest);
    }
    return box;
}

}  // namespace treeform::detail
