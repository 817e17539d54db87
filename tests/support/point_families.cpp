#include <support/point_families.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace treeform::test {
namespace {

/// `x` without what a float does not hold, toward zero.
double truncated_to_float(double x) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & ~std::uint64_t{0x1fffffff});
}

template <class Function>
point3 each(const point3& p, const Function& f) {
    return {f(p.x), f(p.y), f(p.z)};
}

}  // namespace

point3 point_stream::any(double scale) {
    const auto coordinate = [&] { return (2.0 * random_.unit() - 1.0) * scale; };
    const double x = coordinate();
    const double y = coordinate();
    return {x, y, coordinate()};
}

/// A double with exponent from `least` to `least + spread`; one in four is a zero or a power of
/// two.
double point_stream::extreme(int least, int spread) {
    const double sign = random_.one_in(2) ? 1.0 : -1.0;
    const int exponent =
        least + static_cast<int>(random_.below(static_cast<std::uint64_t>(spread)));
    if (random_.one_in(8)) return sign * 0.0;
    if (random_.one_in(7)) return sign * std::ldexp(1.0, exponent);
    return sign * std::ldexp(0.5 + 0.5 * random_.unit(), exponent + 1);
}

double point_stream::moved(double x) {
    if (!random_.one_in(3)) return x;
    return std::nextafter(x, random_.one_in(2) ? 1e308 : -1e308);
}

/// Points o + s u + t v, where s and t are small fractions and o, u and v have few bits, so that
/// sums are exact unless `rounded` makes them long. Often t = 0, or the numbers repeat.
std::vector<point3> point_stream::flat(std::size_t count, bool rounded, double offset) {
    const auto vector = [&] {
        if (rounded) return any(1.0);
        const double x = random_.whole(-1000, 1000);
        const double y = random_.whole(-1000, 1000);
        return point3{x, y, random_.one_in(3) ? 0.0 : random_.whole(-1000, 1000)};
    };
    const point3 o = each(vector(), [&](double x) { return x + offset; });
    const point3 u = vector();
    const point3 v = vector();
    const bool line = random_.one_in(3);
    const bool moves = !rounded && random_.one_in(2);
    std::vector<point3> points(count);
    for (point3& p : points) {
        const double s = random_.whole(-32, 32) / 16.0;
        const double t = line ? 0.0 : random_.whole(-32, 32) / 16.0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            p[axis] = o[axis] + (s * u[axis] + t * v[axis]);
        if (moves) p = each(p, [&](double x) { return moved(x); });
    }
    return points;
}

std::vector<point3> point_stream::next(std::size_t count) {
    constexpr std::array offsets = {1e3, 1e6, 1e9, 0x1p40};
    constexpr std::array steps = {1.0, 0.125, 0.1};
    if (family_ == point_family::rounded_flat) return flat(count, true, 0.0);
    if (family_ == point_family::exact_flat) return flat(count, false, 0.0);
    if (family_ == point_family::offset) {
        const bool rounded = random_.one_in(4);
        return flat(count, rounded, offsets[random_.below(offsets.size())]);
    }

    // As wide as doubles get, or a window of 2^3 to 2^10 somewhere in their range.
    const int spread = std::min(2098, 1 << (3 + random_.below(9)));
    const int least =
        -1074 + static_cast<int>(random_.below(static_cast<std::uint64_t>(2099 - spread)));

    std::vector<point3> points(count);
    const double step = steps[random_.below(steps.size())];
    const double offset = random_.whole(-3, 3);
    for (point3& p : points) {
        switch (family_) {
            case point_family::random:
                p = any(1.0);
                break;
            case point_family::float_born:
                p = each(any(1.0), truncated_to_float);
                break;
            case point_family::mixed_scales:
                p = any(random_.one_in(2) ? 1e-6 : 1e6);
                break;
            case point_family::grid:
                p = each(p, [&](double) { return (offset + random_.whole(-2, 2)) * step; });
                break;
            case point_family::denormal:
                p = each(p, [&](double) { return random_.whole(-5, 5) * 0x1p-1074; });
                break;
            default:
                p = each(p, [&](double) { return extreme(least, spread); });
                break;
        }
    }
    // In two of three groups of the last family coordinates are taken over from the first point.
    if (family_ == point_family::extreme && !random_.one_in(3))
        for (point3& p : points)
            for (std::size_t axis = 0; axis < 3; ++axis)
                if (random_.one_in(3)) p[axis] = points[0][axis];
    return points;
}

}  // namespace treeform::test
