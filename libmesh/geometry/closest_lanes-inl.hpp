/// \file
/// Closest points of several triangles at once, in SIMD lanes. Included once for each target of
/// Highway.

#if defined(TREEFORM_CLOSEST_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TREEFORM_CLOSEST_LANES_INL
#undef TREEFORM_CLOSEST_LANES_INL
#else
#define TREEFORM_CLOSEST_LANES_INL
#endif

#include <hwy/highway.h>

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::geometry::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// One triangle in each lane: the members of `based_triangle`, and p - corner. V is a vector of
/// doubles.
template <class V>
struct based_lanes {
    V base[3];
    V height[3];
    V from[3];
    V apex, per_base, per_height;
};

template <class V>
struct closest_lanes {
    V s, t, squared;
};

template <class V>
HWY_INLINE V dot_lanes(const V (&a)[3], const V (&b)[3]) {
    return hn::Add(hn::Add(hn::Mul(a[0], b[0]), hn::Mul(a[1], b[1])), hn::Mul(a[2], b[2]));
}

/// The point of each triangle nearest to p, and its squared distance from p.
///
/// The foot (s, t) of p in the plane is the answer if it lies in the triangle. Else it is the
/// nearest of the feet on the three edges, each clamped to its edge, in the metric of the plane:
/// ds^2 + q dt^2 times base^2, q = height^2 / base^2. No operation is fused, so that the answer is
/// the same on every processor.
template <class D, class V = hn::Vec<D>>
HWY_INLINE closest_lanes<V> closest_on(D d, const based_lanes<V>& of) {
    const V zero = hn::Zero(d);
    const V one = hn::Set(d, 1.0);
    const V least = hn::Set(d, 1e-300);
    const auto clamp = [&](V x) { return hn::Min(hn::Max(x, zero), one); };
    const V s = hn::Mul(dot_lanes(of.from, of.base), of.per_base);
    // Remove the component along the base: after rounding, a short height is not perpendicular to
    // it.
    V across[3];
    for (std::size_t k = 0; k < 3; ++k) across[k] = hn::Sub(of.from[k], hn::Mul(s, of.base[k]));
    const V t = hn::Mul(dot_lanes(across, of.height), of.per_height);
    const V q = hn::Mul(dot_lanes(of.height, of.height), of.per_base);
    const V qt = hn::Mul(q, t);
    const V rest = hn::Sub(one, of.apex);
    const V back = hn::Sub(one, s);

    // From either end of the base toward the apex.
    const V left = clamp(hn::Div(hn::Add(hn::Mul(s, of.apex), qt),
                                 hn::Max(hn::Add(hn::Mul(of.apex, of.apex), q), least)));
    const V right = clamp(
        hn::Div(hn::Add(hn::Mul(back, rest), qt), hn::Max(hn::Add(hn::Mul(rest, rest), q), least)));
    const auto miss = [&](V at_s, V at_t) {
        const V ds = hn::Sub(s, at_s);
        const V dt = hn::Sub(t, at_t);
        return hn::Add(hn::Mul(ds, ds), hn::Mul(q, hn::Mul(dt, dt)));
    };
    V best_s = clamp(s);
    V best_t = zero;
    V best = miss(best_s, best_t);
    const auto offer = [&](V at_s, V at_t) {
        const V now = miss(at_s, at_t);
        const auto nearer = hn::Lt(now, best);
        best_s = hn::IfThenElse(nearer, at_s, best_s);
        best_t = hn::IfThenElse(nearer, at_t, best_t);
        best = hn::Min(now, best);
    };
    offer(hn::Mul(left, of.apex), left);
    offer(hn::Sub(one, hn::Mul(right, rest)), right);

    const auto inside = hn::And(
        hn::Ge(t, zero), hn::And(hn::Ge(s, hn::Mul(t, of.apex)), hn::Ge(back, hn::Mul(t, rest))));
    closest_lanes<V> found;
    found.s = hn::IfThenElse(inside, s, best_s);
    found.t = hn::IfThenElse(inside, t, best_t);
    found.squared = zero;
    for (std::size_t k = 0; k < 3; ++k) {
        const V gap = hn::Sub(
            of.from[k], hn::Add(hn::Mul(found.s, of.base[k]), hn::Mul(found.t, of.height[k])));
        found.squared = hn::Add(found.squared, hn::Mul(gap, gap));
    }
    return found;
}

}  // namespace
}  // namespace treeform::detail::geometry::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
