#include <libmesh/base/point_math.hpp>
#include <libmesh/geometry/based_triangle.hpp>
#include <libmesh/geometry/closest_point.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

// One triangle needs no lanes: the baseline of the processor will do.
#undef HWY_TARGET_INCLUDE
#include <libmesh/geometry/closest_lanes-inl.hpp>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::geometry::HWY_NAMESPACE {
namespace {

closest_on_triangle closest_on_one(const based_triangle& t, const point3& p) {
    const hn::CappedTag<double, 1> d;
    using lane = hn::Vec<decltype(d)>;
    based_lanes<lane> of;
    const point3 from = base::minus(p, t.corner);
    for (std::size_t k = 0; k < 3; ++k) {
        of.base[k] = hn::Set(d, t.base[k]);
        of.height[k] = hn::Set(d, t.height[k]);
        of.from[k] = hn::Set(d, from[k]);
    }
    of.apex = hn::Set(d, t.apex);
    of.per_base = hn::Set(d, t.per_base);
    of.per_height = hn::Set(d, t.per_height);
    const auto found = closest_on(d, of);
    return {t.at(hn::GetLane(found.s), hn::GetLane(found.t)), hn::GetLane(found.squared)};
}

}  // namespace
}  // namespace treeform::detail::geometry::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace treeform {

closest_on_triangle closest_point(const triangle3& t, const point3& p) {
    return detail::geometry::HWY_STATIC_DISPATCH(closest_on_one)(
        detail::geometry::based_triangle(t), p);
}

double detail::geometry::squared_distance(const based_triangle& t, const point3& p) {
    // As `closest_on`, in plain doubles: without the places, and what is beside only where it is.
    const point3 from = base::minus(p, t.corner);
    double s = base::dot(from, t.base) * t.per_base;
    double r = base::dot(base::minus(from, base::scaled(t.base, s)), t.height) * t.per_height;
    const double rest = 1.0 - t.apex;
    if (!(r >= 0.0 && s >= r * t.apex && 1.0 - s >= r * rest)) {
        const double q = base::dot(t.height, t.height) * t.per_base;
        const auto clamp = [](double x) { return std::min(std::max(x, 0.0), 1.0); };
        const auto up = [&](double way, double apex) {
            return clamp((way * apex + q * r) / std::max(apex * apex + q, 1e-300));
        };
        const double left = up(s, t.apex), right = up(1.0 - s, rest);
        const std::array<std::array<double, 2>, 3> feet{
            {{clamp(s), 0.0}, {left * t.apex, left}, {1.0 - right * rest, right}}};
        const auto miss = [&](const std::array<double, 2>& at) {
            return (s - at[0]) * (s - at[0]) + q * ((r - at[1]) * (r - at[1]));
        };
        const std::array<double, 3> misses{miss(feet[0]), miss(feet[1]), miss(feet[2])};
        std::size_t best = misses[1] < misses[0] ? 1 : 0;
        if (misses[2] < misses[best]) best = 2;
        s = feet[best][0];
        r = feet[best][1];
    }
    const point3 gap =
        base::minus(from, base::plus(base::scaled(t.base, s), base::scaled(t.height, r)));
    return base::dot(gap, gap);
}

}  // namespace treeform
