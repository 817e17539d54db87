#pragma once
/// \file
/// Chooses the frame of a tree: the origin and scale of its float boxes.

#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace treeform::detail {

/// Chooses origin and scale from a sample of up to 64 boxes, at positions that depend on `size`
/// only. The origin is the median of their corners, which is robust to outliers; the scale is the
/// power of two that brings their extent near 1. Any choice is correct; this one keeps boxes tight.
template <std::size_t D, class BoxOf>
[[nodiscard]] tree_frame<D> frame_of(std::size_t size, const BoxOf& box_of) {
    tree_frame<D> frame;
    const std::size_t count = std::min<std::size_t>(size, 64);
    if (count == 0) return frame;
    std::array<std::array<double, 64>, D> sample;
    for (std::size_t i = 0; i < count; ++i) {
        const auto box = box_of(i * size / count);
        for (std::size_t k = 0; k < D; ++k) sample[k][i] = static_cast<double>(box.min[k]);
    }
    double extent = 0.0;
    for (std::size_t k = 0; k < D; ++k) {
        const auto end = sample[k].begin() + static_cast<std::ptrdiff_t>(count);
        for (auto value = sample[k].begin(); value != end; ++value)
            if (!std::isfinite(*value)) *value = 0.0;  // reported when the boxes are rounded
        std::sort(sample[k].begin(), end);
        frame.origin[k] = sample[k][count / 2];
        // Halved, so that the extent of two extreme doubles is finite.
        extent = std::max(extent, 0.5 * *(end - 1) - 0.5 * sample[k][0]);
    }
    if (extent > 0.0)
        frame.scale = std::ldexp(1.0, std::clamp(-std::ilogb(extent) - 1, -1000, 1000));
    return frame;
}

/// Whether a tree can contain the box: not empty, no NaN, no infinity.
template <class Box>
[[nodiscard]] bool is_finite(const Box& box) {
    using scalar = typename Box::scalar;
    bool finite = true;
    for (std::size_t k = 0; k < Box::dimensions; ++k)
        finite = finite && box.min[k] <= box.max[k] &&
                 box.min[k] >= std::numeric_limits<scalar>::lowest() &&
                 box.max[k] <= std::numeric_limits<scalar>::max();
    return finite;
}

}  // namespace treeform::detail
