#pragma once
/// \file
/// The frame of a tree: where its float boxes are centred, and how boxes are rounded into it.

#include <libtree/detail/build_records.hpp>
#include <libtree/tree.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace tf::detail {

/// Chooses origin and scale from a sample of up to 64 boxes at places that depend on `size` only:
/// the median of their corners, which a few stray boxes do not move, and the power of two that
/// brings their extent near 1. Any choice is correct; this one keeps boxes tight.
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
            if (!std::isfinite(*value)) *value = 0.0;  // the fill that follows reports it
        std::sort(sample[k].begin(), end);
        frame.origin[k] = sample[k][count / 2];
        // Halved, so that the extent of two extreme doubles is finite.
        extent = std::max(extent, 0.5 * *(end - 1) - 0.5 * sample[k][0]);
    }
    if (extent > 0.0)
        frame.scale = std::ldexp(1.0, std::clamp(-std::ilogb(extent) - 1, -1000, 1000));
    return frame;
}

/// Whether a tree can hold a box: not empty, no NaN, no infinity.
template <class Box>
[[nodiscard]] bool is_finite(const Box& box) {
    using scalar = typename Box::scalar;
    bool finite = true;
    for (std::size_t k = 0; k < Box::dimensions; ++k)
        finite &= (box.min[k] <= box.max[k]) &
                  (box.min[k] >= std::numeric_limits<scalar>::lowest()) &
                  (box.max[k] <= std::numeric_limits<scalar>::max());
    return finite;
}

/// Rounds boxes outward into a frame, as a centre and half extents.
template <std::size_t D>
class rounder {
  public:
    explicit rounder(const tree_frame<D>& frame) : frame_(frame) {}

    /// Writes the record of element `id` and how far its box reaches from there; false for a box
    /// that is empty or not finite.
    template <class Box>
    bool operator()(const Box& box, std::uint32_t id, split_record& record,
                    half_extents& extents) const {
        float half[D];
        record.center[2] = 0.0F;
        for (std::size_t k = 0; k < D; ++k) {
            const float lo = to_float(static_cast<double>(box.min[k]), k);
            const float hi = to_float(static_cast<double>(box.max[k]), k);
            const float center = 0.5F * lo + 0.5F * hi;
            record.center[k] = center;
            half[k] =
                std::max(hi - center, center - lo) + margin(std::max(std::abs(lo), std::abs(hi)));
        }
        record.id = id;
        extents = half_extents(half);
        return is_finite(box);
    }

  private:
    /// (x - origin) * scale, to about 2^-24, clamped to the range of float.
    [[nodiscard]] float to_float(double x, std::size_t k) const {
        constexpr double limit = std::numeric_limits<float>::max();
        double y = (x - frame_.origin[k]) * frame_.scale;
        y = y < -limit ? -limit : y;
        y = limit < y ? limit : y;
        return static_cast<float>(y);
    }

    /// What makes center - half and center + half, rounded to float, lie outside the exact image
    /// of a box with |lo|, |hi| <= m. With u = 2^-24:
    /// - `to_float` is off by at most u |y| of the rounding to float and 2^-53 |y| of the
    /// difference,
    ///   for the exact value y: by less than 1.01 u m;
    /// - hi - center <= 2 m is off by u times itself, adding the margin by u (2 m + margin), and
    /// the
    ///   final center + half, which is at most m + margin off where it should be, by
    ///   u (m + margin) beyond what it gains: together by less than 5.01 u m + 2 u margin.
    /// Six units are 3.6e-7 m < 4.8e-7 m. Where m is so small that the product is flushed to 0, the
    /// errors are below the least normal float, 1.2e-38. Scaling is exact but for underflow, which
    /// that covers too. A clamped coordinate moves out to infinity: 4.8e-7 max is more than half an
    /// ulp of max; inward it stays finite, which is right since x lies further out.
    [[nodiscard]] static float margin(float m) { return m * 4.8e-7F + 1e-37F; }

    tree_frame<D> frame_;
};

}  // namespace tf::detail
