#pragma once
/// \file
/// Maps boxes from the frame of a tree, after a transform, into a frame common to two trees.

#include <treeform/tree/aabb.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace treeform::detail {

/// A box [min, max] of the tree becomes, on axis k of the common frame and rounded outward,
///   offset[k] + the interval sum of linear[k][j] * [min[j], max[j]]
///   -+ (slack_offset[k] + sum of slack[k][j] * reach[j]),   reach = max(|min|, |max|),
/// in float, the sum from left to right with or without fused multiply-adds.
///
/// Proof that this slack suffices. Let l, q be the exact coefficients, u = 2^-24, and S = |q| + sum
/// of |l| reach. `linear` and `offset` hold l and q to 1 u (q also to its own error, below); a term
/// then takes part in a product and at most D sums, and the result in one more when the slack is
/// subtracted: (D + 3) u S <= 6 u S to first order. The slack is 8 u S, itself computed to 5 u. The
/// remaining 2 u S hold the second order, and the error of a point moved in double, (D + 1) 2^-53
/// (sum of |M| |x| + |t|), as far as that is relative to S; the rest of it, and the error of q, (D
/// + 2) 2^-53 Q for the sum Q of the magnitudes that make up q, are together below 2^-49 Q.
/// Underflow: a coefficient flushed to 0 is off by 2^-126, times reach; `slack` has 2^-90 for it,
/// so that, if l is 0, its product with reach is not a denormal, which would cost a hundred cycles.
/// Products and sums are off by 2^-126 each, together below 1e-36.
///
/// Overflow: an infinite or NaN result becomes an infinite side, since the slack overflows with, or
/// before, the sum to which it belongs.
template <std::size_t D>
struct frame_map {
    bool identity = true;   ///< boxes do not change; the members below are not set
    bool diagonal = false;  ///< `linear` has no entries off its diagonal
    float linear[D][D] = {};
    float offset[D] = {};
    float slack[D][D] = {};
    float slack_offset[D] = {};
    /// Sides are clamped to this limit before they are mapped, since a side that the build clamped
    /// inward only means that the coordinate is at least that far out, or differs from the origin
    /// by more than the largest double.
    float limit = std::numeric_limits<float>::max();
};

/// A float near `x`; infinite if `x` is large or NaN, for which a cast is undefined.
inline float float_or_infinity(double x) {
    if (std::abs(x) <= 0x1p100) return static_cast<float>(x);
    return x < 0.0 ? -std::numeric_limits<float>::infinity()
                   : std::numeric_limits<float>::infinity();
}

/// Axis `k` of the origin of frame `from`, transformed by `by`, minus the origin of `to`. Sets
/// `magnitude` to the sum of the magnitudes of all terms.
template <std::size_t D>
double origin_shift(const tree_frame<D>& from, const transform<D>& by, const tree_frame<D>& to,
                    std::size_t k, double& magnitude) {
    double sum = by.rows[k][D] - to.origin[k];
    magnitude = std::abs(by.rows[k][D]) + std::abs(to.origin[k]);
    for (std::size_t j = 0; j < D; ++j) {
        const double part = by.rows[k][j] * from.origin[j];
        sum += part;
        magnitude += std::abs(part);
    }
    return sum;
}

template <std::size_t D>
frame_map<D> map_into(const tree_frame<D>& from, const transform<D>& by, const tree_frame<D>& to) {
    frame_map<D> map;
    const bool moves = by != transform<D>{};
    if (!moves && from == to) return map;
    map.identity = false;
    map.diagonal = true;
    const int exponent = std::ilogb(to.scale) - std::ilogb(from.scale);
    for (std::size_t k = 0; k < D; ++k) {
        double magnitude = 0.0;
        map.offset[k] = float_or_infinity(origin_shift(from, by, to, k, magnitude) * to.scale);
        map.slack_offset[k] = 0x1p-21F * std::abs(map.offset[k]) +
                              float_or_infinity(0x1.01p-49 * magnitude * to.scale) + 1e-36F;
        for (std::size_t j = 0; j < D; ++j) {
            // At most one rounding; the ratio of the scales alone may not be representable.
            map.linear[k][j] = float_or_infinity(std::ldexp(by.rows[k][j], exponent));
            map.slack[k][j] = 0x1p-21F * std::abs(map.linear[k][j]) + 0x1p-90F;
            if (j != k && by.rows[k][j] != 0.0) map.diagonal = false;
        }
    }
    map.limit = static_cast<float>(
        std::min(from.scale * (0.999 * std::numeric_limits<double>::max()), 0x1.fffffep127));
    return map;
}

/// The larger of two lengths in space: the distance of the origin of `from`, moved by `by`, from
/// the origin of `to`; and the length of the moved unit of `from`.
template <std::size_t D>
double span_in(const tree_frame<D>& from, const transform<D>& by, const tree_frame<D>& to) {
    double span = 0.0;
    for (std::size_t k = 0; k < D; ++k) {
        double magnitude = 0.0, row = 0.0;
        span = std::max(span, std::abs(origin_shift(from, by, to, k, magnitude)));
        for (std::size_t j = 0; j < D; ++j) row += std::abs(by.rows[k][j]);
        span = std::max(span, row / from.scale);
    }
    return span;
}

/// A frame in which both trees can be compared: that of `b` unless it is moved, else that of `a`.
/// It is coarser if the other tree is so much larger, or so far away, that its boxes would leave
/// the range of float; the boxes of the finer tree are then small compared with the roundings of
/// the coarser ones.
template <std::size_t D>
tree_frame<D> common_frame(const tree_frame<D>& a, const transform<D>& by_a, const tree_frame<D>& b,
                           const transform<D>& by_b) {
    tree_frame<D> frame = by_b == transform<D>{} || by_a != transform<D>{} ? b : a;
    const double span = std::max(span_in(a, by_a, frame), span_in(b, by_b, frame));
    if (!(span * frame.scale <= 0x1p60)) {
        const int exponent = std::isfinite(span) ? std::ilogb(span) : 1060;
        frame.scale = std::ldexp(1.0, std::max(59 - exponent, -1000));
    }
    return frame;
}

}  // namespace treeform::detail
