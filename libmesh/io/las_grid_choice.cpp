#include <libmesh/io/las_dimensions.hpp>
#include <libmesh/io/las_grid_choice.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace treeform::detail::io {
namespace {

constexpr double reach = 2147483000.0;

double las_unit_of(int digits) { return 1.0 / std::pow(10.0, digits); }
double half_of(const las_grid_choice::range& r) { return 0.5 * r.high - 0.5 * r.low; }
double largest_of(const las_grid_choice::range& r) {
    return std::max(std::abs(r.low), std::abs(r.high));
}

}  // namespace

void las_grid_choice::look(std::span<const point3> points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        range& r = ranges_[axis];
        for (const point3& p : points) {
            r.low = std::min(r.low, p[axis]);
            r.high = std::max(r.high, p[axis]);
        }
    }
}

void las_grid_choice::add(std::size_t axis, const range& seen) {
    ranges_[axis].low = std::min(ranges_[axis].low, seen.low);
    ranges_[axis].high = std::max(ranges_[axis].high, seen.high);
}

/// From the middle, both halves have 31 bits.
double las_grid_choice::offset(std::size_t axis, int d) const {
    const range& r = ranges_[axis];
    const bool near = largest_of(r) / las_unit_of(d) <= reach;
    return near ? 0.0 : std::nearbyint(r.low + half_of(r));
}

bool las_grid_choice::may_be(std::size_t axis, int d) const {
    const range& r = ranges_[axis];
    if (!std::isfinite(r.low) || !std::isfinite(r.high)) return false;  // refused, or nothing there
    const double from = offset(axis, d);
    return d <= most_digits && std::max(r.high - from, from - r.low) / las_unit_of(d) <= reach;
}

bool las_grid_choice::holds(std::size_t axis, std::span<const point3> points) const {
    const double unit = las_unit_of(digits_[axis]);
    const double from = offset(axis, digits_[axis]);
    const double within = 2 * largest_of(ranges_[axis]) * std::numeric_limits<double>::epsilon();
    const las_grid grid{{unit, unit, unit}, {from, from, from}};
    return std::all_of(points.begin(), points.end(), [&](const point3& p) {
        const double x = std::nearbyint((p[axis] - from) / unit);
        return std::abs(x) <= std::numeric_limits<std::int32_t>::max() &&
               std::abs(grid.coordinate(axis, static_cast<std::int32_t>(x)) - p[axis]) <= within;
    });
}

void las_grid_choice::try_on(std::span<const point3> points) {
    const digits before = digits_;
    for (std::size_t axis = 0; axis < 3; ++axis)
        while (may_be(axis, digits_[axis]) && !holds(axis, points)) ++digits_[axis];
    // Where none is left, none is to be tried.
    for (std::size_t axis = 0; axis < 3; ++axis)
        moved_ = moved_ || (tried_ && digits_[axis] != before[axis] && may_be(axis, digits_[axis]));
    tried_ = true;
}

void las_grid_choice::start_round(const digits& least) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        digits_[axis] = std::max(digits_[axis], least[axis]);
    tried_ = false;
    moved_ = false;
}

void las_grid_choice::put(las_header& header, const las_grid_wish& wish) const {
    put(header);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const range& r = ranges_[axis];
        if (wish.scale) header.scale[axis] = (*wish.scale)[axis];
        if (wish.offset) header.offset[axis] = (*wish.offset)[axis];
        if (!std::isfinite(r.low) || !std::isfinite(r.high)) continue;
        if (wish.scale && !wish.offset) {
            const bool near = largest_of(r) / header.scale[axis] <= reach;
            header.offset[axis] = near ? 0.0 : std::nearbyint(r.low + half_of(r));
        } else if (wish.offset && !wish.scale) {
            const double from = header.offset[axis];
            const double far = std::max(r.high - from, from - r.low);
            int d = digits_[axis];
            while (far / las_unit_of(d) > reach) --d;
            header.scale[axis] = las_unit_of(d);
        }
    }
}

void las_grid_choice::put(las_header& header) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const range& r = ranges_[axis];
        if (!std::isfinite(r.low) || !std::isfinite(r.high)) continue;
        int d = digits_[axis];
        while (d >= 0 && !may_be(axis, d)) --d;
        if (d >= 0) {
            header.scale[axis] = las_unit_of(d);
            header.offset[axis] = offset(axis, d);
        } else {
            header.scale[axis] =
                std::max(half_of(r) / reach * (1 + 1e-9), std::numeric_limits<double>::min());
            header.offset[axis] = r.low + half_of(r);
        }
    }
}

}  // namespace treeform::detail::io
