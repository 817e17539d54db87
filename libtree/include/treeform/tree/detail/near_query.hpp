#pragma once
/// \file
/// The query of a nearness search, as floats in the frame of the tree, and the bound to which box
/// distances are compared.

#include <treeform/tree/aabb.hpp>
#include <treeform/tree/tree.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace treeform::detail {

/// A float that is at least x, at most the largest float; if |x| is in range, it exceeds x by at
/// most 2^-21 |x| or 1e-36.
inline float float_above(double x) {
    constexpr float limit = std::numeric_limits<float>::max();
    if (x >= static_cast<double>(limit)) return limit;
    const auto f = static_cast<float>(x < -static_cast<double>(limit) ? -limit : x);
    const float up = f + (std::abs(f) * 2.4e-7F + 1e-37F);
    return up < limit ? up : limit;
}

/// The bound that a squared distance of boxes, computed in float in a frame, must exceed to prove
/// that nothing in the boxes is as near as a given squared distance.
///
/// A node test computes, in float and in any rounding mode, the sum over the axes of the squares of
/// max(0, min - high, low - max), for boxes rounded outward. Let S be the exact squared distance of
/// their contents in the frame; the exact sum is at most S. With u = 2^-23, a difference, its
/// square and the sums (D <= 3, fused or not) are off by a factor of at most (1 + u)^5 < 1 +
/// 2^-20.6, and by 2^-126 for each flushed square or denormal read as zero, together below 1e-37.
/// So the computed value s obeys s <= S (1 + 2^-20.6) + 1e-37, and s > bound(best) proves S > best
/// (1 + 2^-21): skipped boxes are further than `best`, even by the caller's own distances if these
/// are not too small by more than a relative error of 2^-22.
///
/// When s overflows while the bound is finite, S > best as well; with an infinite bound nothing is
/// skipped. Sides beyond the range of float are clamped inward to its limits. Only for frames with
/// an extent beyond 1e267, where differences of coordinates overflow double before they overflow
/// float, would a clamped side be further out than the exact one; there the bound stays infinite.
class near_bound {
  public:
    /// Squared distances will be those of coordinates times `unit`, a power of two.
    explicit near_bound(double frame_scale, double unit = 1.0)
        : scale_(frame_scale < 0x1p-890 ? std::numeric_limits<double>::infinity()
                                        : frame_scale / unit) {}

    /// Multiplied in two steps, since the square of the scale may overflow. If a product
    /// underflows, the last term is far larger than the loss.
    [[nodiscard]] float operator()(double squared) const {
        const double scaled = squared * scale_ * scale_;
        if (!(scaled < 3e38)) return std::numeric_limits<float>::infinity();
        return static_cast<float>(scaled * (1.0 + 0x1p-19) + 3e-37);
    }

  private:
    double scale_;
};

/// The box (or point) from which the boxes of a tree are measured, as floats in the frame of the
/// tree, rounded outward. Coordinates beyond the range of float are clamped to its limits; no
/// opposing side is stored further out.
template <std::size_t D>
class near_query {
  public:
    near_query(const tree_frame<D>& frame, const aabb<double, D>& box, double unit = 1.0)
        : bound_of(frame.scale, unit) {
        for (std::size_t k = 0; k < D; ++k) {
            low[k] = -float_above(-(box.min[k] - frame.origin[k]) * frame.scale);
            high[k] = float_above((box.max[k] - frame.origin[k]) * frame.scale);
        }
    }

    std::array<float, D> low;
    std::array<float, D> high;
    near_bound bound_of;
};

/// A node still to be opened or skipped.
struct near_entry {
    float lower;
    std::uint32_t index;
    unsigned level;
};

/// Largest number of pending entries of a depth-first search: eleven levels of 8, for 2^33
/// primitives.
inline constexpr std::size_t near_depth = 88;

}  // namespace treeform::detail
