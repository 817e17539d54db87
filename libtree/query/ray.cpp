#include <treeform/tree/ray.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libtree/query/ray.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef TREEFORM_RAY_ONCE
#define TREEFORM_RAY_ONCE
namespace treeform::detail {
namespace {

// The slab test, and why it misses nothing.
//
// Scaled by powers of two, the ray runs in the frame of the tree as y(s) = O + s D with the largest
// |D_k| in [1, 2) and s = t 2^exponent. So that floats do, s is counted from `shift`, about where
// the ray enters the root: y = P + s' D with P = O + shift D.
//
// P is known to within some pad_k, so low_k <= P_k <= high_k in float. With D_k > 0 the ray is
// beyond the plane m_k of a box from s' = (m_k - P_k) / D_k >= (m_k - high_k) / D_k on, and not yet
// beyond M_k until (M_k - P_k) / D_k <= (M_k - low_k) / D_k; with D_k < 0 planes change places:
// from (M_k - low_k) / D_k until (m_k - high_k) / D_k. These bounds are computed with a rounding of
// the difference, of the product, and those of 1 / D_k: D_k itself, its inverse in double, and that
// in float. In any rounding mode each is below 2^-23, together below 3.1 * 2^-23, and multiplying
// the result by 1 +- 2^-20 moves it outward by more than these and its own rounding. This works on
// infinite results, too: what overflows for one axis and only nearly for another comes out equal.
//
// Underflow: a difference below 2^-126 may be flushed, and a denormal plane read as 0; the 1e-37
// that `above` adds to a pad exceeds both (where it is lost in rounding, P_k has an ulp above 1e-44
// only together with |P_k| > 2^-103, and nothing underflows). A product may be flushed: 1e-37
// again.
//
// D_k = 0: 1 / D_k is infinite, and the bounds are -inf and +inf while m_k <= P_k <= M_k, since
// high_k exceeds P_k for sure; 0 * inf = NaN comes up only where the ray misses. Components that
// are tiny beside the others are treated as 0, their largest effect being part of the pad; where a
// pad is infinite the axis is not looked at.

/// A float not below x, more by 2^-22 of it or 1e-37.
float above(double x) {
    constexpr double limit = std::numeric_limits<float>::max();
    if (x > limit) return std::numeric_limits<float>::infinity();
    const auto f = static_cast<float>(x < -limit ? -limit : x);
    return f + (std::abs(f) * 2.4e-7F + 1e-37F);
}
float below(double x) { return -above(-x); }

struct interval {
    double begin, end;
};

template <std::size_t D>
class framed_ray {
  public:
    framed_ray(const tree<D>& tree, const ray<double, D>& ray) {
        set_direction(tree.frame(), ray);
        std::array<double, D> origin;
        for (std::size_t k = 0; k < D; ++k)  // not finite where it overflows
            origin[k] = (ray.origin[k] - tree.frame().origin[k]) * tree.frame().scale;
        const double first =
            std::min(std::ldexp(ray.t_min, exponent_), std::numeric_limits<double>::max());
        const interval near_root =
            clipped({first, std::ldexp(ray.t_max, exponent_)}, tree.level(0)[0], origin);
        shift_ = std::isfinite(near_root.begin) ? near_root.begin : 0.0;
        const double reach =
            std::max(std::abs(near_root.begin - shift_), std::abs(near_root.end - shift_));
        for (std::size_t k = 0; k < D; ++k)
            set_axis(k, origin[k], ray.direction[k] == 0.0 ? 0.0 : reach);
        if (!is_point_)
            begin = below(first - shift_ - 0x1p-50 * (std::abs(first) + std::abs(shift_)));
        end = end_of(ray.t_max);
    }

    /// The float s' at or beyond which the parameter t lies, t being wrong by 2^-40 of itself.
    [[nodiscard]] float end_of(double t) const {
        if (is_point_) return 0.0F;
        const double s = std::ldexp(t, exponent_);
        if (!(s < std::numeric_limits<double>::max()))
            return std::numeric_limits<float>::infinity();
        if (!(s > -std::numeric_limits<double>::infinity())) return static_cast<float>(s);
        const float f = above(s - shift_ + 0x1p-39 * (std::abs(s) + std::abs(shift_)));
        return f + (std::abs(f) * 0x1p-20F + 1e-37F);
    }

    std::array<float, D> low, high;  ///< around P
    std::array<float, D> inverse;    ///< 1 / D
    std::array<bool, D> falling;     ///< D < 0
    float begin = 0.0F, end = 0.0F;  ///< s' of t_min and t_max, outward; of a point, 0

  private:
    /// Components below this are taken for zero; their inverses are finite floats otherwise.
    static constexpr double least_component = 0x1p-100;

    void set_direction(const tree_frame<D>& frame, const ray<double, D>& ray) {
        double largest = 0.0;
        for (const double x : ray.direction) largest = std::max(largest, std::abs(x));
        is_point_ = largest == 0.0;
        const int size = is_point_ ? 0 : std::ilogb(largest);
        exponent_ = size + std::ilogb(frame.scale);
        for (std::size_t k = 0; k < D; ++k) direction_[k] = std::ldexp(ray.direction[k], -size);
    }

    /// The part of `range` in which the ray is, up to rounding, near the box of all slots. It is
    /// only used as a hint for the shift and as a bound of |s'|, and is never too short.
    [[nodiscard]] interval clipped(interval range, const wide_node<D>& root,
                                   const std::array<double, D>& origin) const {
        for (std::size_t k = 0; k < D; ++k) {
            const double d = direction_[k];
            if (!(std::abs(d) >= least_component) || !std::isfinite(origin[k])) continue;
            const auto [min, max] = bounds(root.min[k], root.max[k]);
            if (!(min <= max)) continue;
            const double pad = 0x1p-50 * std::abs(origin[k]) + 1e-30;
            const double near = ((d > 0.0 ? min : max) - origin[k]) / d - pad / std::abs(d);
            const double far = ((d > 0.0 ? max : min) - origin[k]) / d + pad / std::abs(d);
            range.begin = std::max(range.begin, near - std::abs(near) * 0x1p-45);
            range.end = std::min(range.end, far + std::abs(far) * 0x1p-45);
        }
        return range;
    }

    static interval bounds(const float (&min)[8], const float (&max)[8]) {
        float low = min[0];
        float high = max[0];
        for (std::size_t i = 1; i < 8; ++i) {
            low = min[i] < low ? min[i] : low;
            high = high < max[i] ? max[i] : high;
        }
        return {static_cast<double>(low), static_cast<double>(high)};
    }

    void set_axis(std::size_t k, double origin, double reach) {
        const double d = direction_[k];
        const bool runs = std::abs(d) >= least_component;
        const double p = origin + shift_ * d;
        // A rounding each of the origin, the product and their sum, and what a component that is
        // taken for zero, while it is not, does over the length of the ray near the tree.
        double pad = 0x1p-50 * (std::abs(origin) + std::abs(shift_ * d));
        if (!runs && reach != 0.0) pad += 2.0 * reach * least_component;
        falling[k] = d < 0.0 && runs;
        inverse[k] = runs ? static_cast<float>(1.0 / d) : std::numeric_limits<float>::infinity();
        low[k] = below(p - pad);
        high[k] = above(p + pad);
        if (std::isfinite(p) && std::isfinite(pad)) return;
        low[k] = -std::numeric_limits<float>::infinity();
        high[k] = std::numeric_limits<float>::infinity();
        inverse[k] = 1.0F;
        falling[k] = false;
    }

    bool is_point_ = false;
    int exponent_ = 0;  ///< s = t 2^exponent
    std::array<double, D> direction_;
    double shift_;
};

/// A node or, below the last level, a primitive's place, and where the ray enters its box.
struct pending {
    float entry;
    std::uint32_t index;
    unsigned level;
};

using place_visitor = function_ref<double(std::uint32_t)>;

}  // namespace
}  // namespace treeform::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Which boxes of `node` the ray meets up to `end`, a bit each, and where it enters all of them.
template <std::size_t D>
unsigned met(const wide_node<D>& node, const framed_ray<D>& ray, float end, float* entry) {
    const hn::CappedTag<float, 8> d;
    const std::size_t lanes = hn::Lanes(d);
    const auto outward = hn::Set(d, 1.0F + 0x1p-20F);
    const auto inward = hn::Set(d, 1.0F - 0x1p-20F);
    const auto least = hn::Set(d, 1e-37F);
    unsigned mask = 0;
    for (std::size_t i = 0; i < 8; i += lanes) {
        auto near = hn::Set(d, -std::numeric_limits<float>::infinity());
        auto far = hn::Set(d, std::numeric_limits<float>::infinity());
        for (std::size_t k = 0; k < D; ++k) {
            const auto min = hn::Sub(hn::Load(d, node.min[k] + i), hn::Set(d, ray.high[k]));
            const auto max = hn::Sub(hn::Load(d, node.max[k] + i), hn::Set(d, ray.low[k]));
            const auto inverse = hn::Set(d, ray.inverse[k]);
            near = hn::Max(near, hn::Mul(ray.falling[k] ? max : min, inverse));
            far = hn::Min(far, hn::Mul(ray.falling[k] ? min : max, inverse));
        }
        near = hn::Sub(hn::Min(hn::Mul(near, outward), hn::Mul(near, inward)), least);
        far = hn::Add(hn::Max(hn::Mul(far, outward), hn::Mul(far, inward)), least);
        near = hn::Max(near, hn::Set(d, ray.begin));
        far = hn::Min(far, hn::Set(d, end));
        // A slot without a box has bounds like any other where an axis is not looked at.
        const auto in_use = hn::Le(hn::Load(d, node.min[0] + i), hn::Load(d, node.max[0] + i));
        hn::Store(near, d, entry + i);
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(d, hn::And(hn::Le(near, far), in_use), bits);
        mask |= (bits[0] & ((1U << lanes) - 1)) << i;
    }
    return mask;
}

/// Adds the children in `mask` so that the one entered first is on top.
void push(std::size_t first, unsigned level, unsigned mask, const float* entry, pending* stack,
          std::size_t& size) {
    const std::size_t bottom = size;
    for (; mask != 0; mask &= mask - 1) {
        const auto slot = static_cast<std::size_t>(std::countr_zero(mask));
        std::size_t at = size++;
        for (; at > bottom && stack[at - 1].entry < entry[slot]; --at) stack[at] = stack[at - 1];
        stack[at] = {entry[slot], static_cast<std::uint32_t>(first + slot), level};
    }
}

template <std::size_t D>
void trace_framed(const tree<D>& t, framed_ray<D> ray, place_visitor visit) {
    // Eleven levels of 8 hold 2^33 primitives, and each leaves 7 entries behind.
    std::array<pending, 88> stack;
    std::array<const wide_node<D>*, 12> level{};
    for (unsigned l = 0; l < t.levels(); ++l) level[l] = t.level(l).data();
    alignas(64) std::array<float, 8> entry;
    std::size_t size = 0;
    stack[size++] = {ray.begin, 0, 0};
    double last = std::numeric_limits<double>::infinity();
    while (size != 0) {
        const pending next = stack[--size];
        if (!(next.entry <= ray.end)) continue;
        if (next.level < t.levels()) {
            const unsigned mask = met(level[next.level][next.index], ray, ray.end, entry.data());
            push(next.index * t.width, next.level + 1, mask, entry.data(), stack.data(), size);
        } else {
            const double t_max = visit(t.ids()[next.index]);
            if (t_max == -std::numeric_limits<double>::infinity()) return;
            if (t_max != last) ray.end = ray.end_of(t_max);
            last = t_max;
        }
    }
}

void trace_2(const tree<2>& t, const framed_ray<2>& ray, place_visitor visit) {
    trace_framed(t, ray, visit);
}
void trace_3(const tree<3>& t, const framed_ray<3>& ray, place_visitor visit) {
    trace_framed(t, ray, visit);
}

}  // namespace
}  // namespace treeform::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace treeform::detail {
namespace {

HWY_EXPORT(trace_2);
HWY_EXPORT(trace_3);

void dispatch(const tree<2>& t, const framed_ray<2>& ray, place_visitor visit) {
    HWY_DYNAMIC_DISPATCH(trace_2)(t, ray, visit);
}
void dispatch(const tree<3>& t, const framed_ray<3>& ray, place_visitor visit) {
    HWY_DYNAMIC_DISPATCH(trace_3)(t, ray, visit);
}

template <std::size_t D>
void check(const ray<double, D>& ray) {
    const auto refuse = [](const char* what) {
        throw std::invalid_argument(std::string("treeform::visit_ray: the ray's ") + what);
    };
    for (std::size_t k = 0; k < D; ++k) {
        if (!std::isfinite(ray.origin[k])) refuse("origin is not finite");
        if (!std::isfinite(ray.direction[k])) refuse("direction is not finite");
    }
    if (std::isnan(ray.t_min) || std::isnan(ray.t_max)) refuse("parameter range is not a number");
}

}  // namespace

template <std::size_t D>
void trace(const tree<D>& tree, const ray<double, D>& ray,
           function_ref<double(std::uint32_t)> visit) {
    check(ray);
    if (tree.empty() || !(ray.t_min <= ray.t_max)) return;
    dispatch(tree, framed_ray<D>(tree, ray), visit);
}

template TREEFORM_API void trace(const tree<2>&, const ray<double, 2>&,
                                 function_ref<double(std::uint32_t)>);
template TREEFORM_API void trace(const tree<3>&, const ray<double, 3>&,
                                 function_ref<double(std::uint32_t)>);

}  // namespace treeform::detail
#endif
