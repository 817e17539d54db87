#include <libmesh/base/point_math.hpp>
#include <libmesh/geometry/contact_point.hpp>
#include <libmesh/geometry/features.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace treeform {
namespace {

using detail::base::cross;
using detail::base::dot;
using detail::base::largest_of;
using detail::base::minus;

using detail::geometry::index_of;
using detail::geometry::next;

struct segment {
    point3 from;
    point3 to;
};

segment edge_of(const triangle3& t, triangle_feature f) {
    const int i = index_of(f);
    return {t[static_cast<std::size_t>(i)], t[static_cast<std::size_t>(next(i))]};
}

struct box {
    point3 low;
    point3 high;
};

box box_of(const triangle3& t, triangle_feature f) {
    const auto [p, q] = edge_of(t, f);
    // The third corner, unless the point is on an edge.
    const point3& r = detail::geometry::is_edge(f)
                          ? p
                          : t[static_cast<std::size_t>(detail::geometry::previous(index_of(f)))];
    box result;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        result.low[axis] = std::min({p[axis], q[axis], r[axis]});
        result.high[axis] = std::max({p[axis], q[axis], r[axis]});
    }
    return result;
}

/// `v` times a power of two that brings its largest component into [1/2, 1).
point3 normalized(const point3& v) {
    int exponent = 0;
    std::frexp(largest_of(v), &exponent);
    return {std::ldexp(v.x, -exponent), std::ldexp(v.y, -exponent), std::ldexp(v.z, -exponent)};
}

/// How far along `s` its ends' distances to a line or plane balance: `at_from` and `at_to` are
/// these distances on one scale. Any value where rounding leaves no distance at all.
double fraction(double at_from, double at_to) {
    const double from = std::abs(at_from);
    const double to = std::abs(at_to);
    return from + to > 0.0 ? from / (from + to) : 0.5;
}

/// The point of `s` at `t` of its length, computed from the nearer end.
point3 along(const segment& s, double t) {
    const bool near_from = t <= 0.5;
    const point3& origin = near_from ? s.from : s.to;
    const double step = near_from ? t : 1.0 - t;
    point3 result;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double length = near_from ? s.to[axis] - s.from[axis] : s.from[axis] - s.to[axis];
        result[axis] = origin[axis] + step * length;
    }
    return result;
}

double fraction_to_plane(const segment& s, const triangle3& plane) {
    const point3 normal =
        cross(normalized(minus(plane[1], plane[0])), normalized(minus(plane[2], plane[0])));
    const point3 n = normalized(normal);
    return fraction(dot(n, minus(s.from, plane[0])), dot(n, minus(s.to, plane[0])));
}

/// Measured in the coordinate plane that the plane of both segments faces most.
double fraction_to_line(const segment& s, const segment& line) {
    const point3 direction = normalized(minus(line.to, line.from));
    const point3 normal = cross(normalized(minus(s.to, s.from)), direction);
    std::size_t axis = 0;
    for (std::size_t other = 1; other < 3; ++other)
        if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
    return fraction(cross(minus(s.from, line.from), direction)[axis],
                    cross(minus(s.to, line.from), direction)[axis]);
}

point3 scaled(const point3& p, int exponent) {
    return {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
}

triangle3 scaled(const triangle3& t, int exponent) {
    return {scaled(t[0], exponent), scaled(t[1], exponent), scaled(t[2], exponent)};
}

/// Power of two by which to multiply both triangles first, so that sums of a few differences do
/// not overflow and products with factors below 1 keep their bits.
int scale_exponent(const triangle3& a, const triangle3& b) {
    double size = 0.0;
    for (std::size_t k = 0; k < 3; ++k) size = std::max({size, largest_of(a[k]), largest_of(b[k])});
    return size > 0x1p1000 ? -64 : size < 0x1p-500 ? 500 : 0;
}

/// A contact on no corner, coordinates in safe range.
point3 crossing_point(const triangle3& a, const triangle3& b, feature_pair c) {
    if (!detail::geometry::is_edge(c.on_a)) {
        assert(detail::geometry::is_edge(c.on_b));
        const segment s = edge_of(b, c.on_b);
        return along(s, fraction_to_plane(s, a));
    }
    const segment s = edge_of(a, c.on_a);
    return along(s, detail::geometry::is_edge(c.on_b) ? fraction_to_line(s, edge_of(b, c.on_b))
                                                      : fraction_to_plane(s, b));
}

point3 clamped(point3 p, const box& to) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        p[axis] = std::clamp(p[axis], to.low[axis], to.high[axis]);
    return p;
}

}  // namespace

point3 approximate_point(const triangle3& a, const triangle3& b, feature_pair c) {
    if (detail::geometry::is_corner(c.on_a)) return a[static_cast<std::size_t>(index_of(c.on_a))];
    if (detail::geometry::is_corner(c.on_b)) return b[static_cast<std::size_t>(index_of(c.on_b))];
    const int exponent = scale_exponent(a, b);
    const point3 p =
        exponent == 0
            ? crossing_point(a, b, c)
            : scaled(crossing_point(scaled(a, exponent), scaled(b, exponent), c), -exponent);
    return clamped(clamped(p, box_of(a, c.on_a)), box_of(b, c.on_b));
}

}  // namespace treeform
