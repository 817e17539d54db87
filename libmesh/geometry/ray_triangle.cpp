#include <libmesh/exact/filter.hpp>
#include <libmesh/exact/plane_predicates.hpp>
#include <libmesh/exact/ray_polynomials.hpp>
#include <libmesh/geometry/contact_order.hpp>
#include <libmesh/geometry/features.hpp>
#include <libmesh/geometry/flat_triangle.hpp>
#include <libmesh/geometry/plane_interval.hpp>
#include <libmesh/geometry/view_axis.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace treeform {
namespace {

using detail::geometry::at;
using signs = std::array<int, 3>;

constexpr point3 zero{};
constexpr std::array<point3, 3> unit{point3{1, 0, 0}, point3{0, 1, 0}, point3{0, 0, 1}};

/// The order of magnitudes, and whether one is zero; also where a processor flushes denormals.
std::uint64_t magnitude_bits(double x) { return std::bit_cast<std::uint64_t>(x) << 1; }

/// Sign of t - s, both known to 2^-40 of `size`; `exact` is asked where that is not enough, or
/// where denormals are not as good as that.
template <class Exact>
int compare_parameters(double t, double s, double size, const Exact& exact) {
    const double gap = t - s;
    const double margin = 0x1p-38 * size;
    if (size >= 0x1p-960 && gap > margin) return 1;
    if (size >= 0x1p-960 && gap < -margin) return -1;
    return exact();
}

/// A ray, as the predicates take it.
class line {
  public:
    line(const ray3& ray, predicate_counters* counters)
        : origin{ray.origin[0], ray.origin[1], ray.origin[2]},
          direction{ray.direction[0], ray.direction[1], ray.direction[2]},
          t_min(ray.t_min),
          t_max(ray.t_max),
          counters_(counters) {}

    /// `direction_side` of origin, p and q.
    [[nodiscard]] int passes(const point3& p, const point3& q) const {
        const int sign = detail::exact::filter_sign<detail::exact::direction_side_polynomial>(
            origin, p, q, direction, zero);
        if (sign != detail::exact::undecided) {
            if (counters_) ++counters_->calls;
            return sign;
        }
        return direction_side(origin, p, q, direction, counters_);
    }
    [[nodiscard]] int side_of(const point3& p, int axis) const {
        return line_side(axis, origin, direction, p, counters_);
    }
    [[nodiscard]] double parameter(const cutting_plane& cut) const {
        return cut_parameter(origin, direction, cut);
    }
    /// Sign of the exact parameter of `cut`, which is about t, minus s.
    [[nodiscard]] int compare(const cutting_plane& cut, double t, double s) const {
        if (std::isinf(s)) return s > 0 ? -1 : 1;
        return compare_parameters(
            t, s, std::abs(t), [&] { return compare_cut(origin, direction, cut, s, counters_); });
    }

    /// The plane through p that is most across the line, of those along two axes.
    [[nodiscard]] cutting_plane through(const point3& p) const {
        std::size_t k = 0;
        for (std::size_t i = 1; i < 3; ++i)
            if (magnitude_bits(direction[i]) > magnitude_bits(direction[k])) k = i;
        const point3& u = unit[(k + 1) % 3];
        const point3& v = unit[(k + 2) % 3];
        return std::signbit(direction[k]) ? cutting_plane{p, zero, v, zero, u}
                                          : cutting_plane{p, zero, u, zero, v};
    }

    point3 origin;
    point3 direction;
    double t_min, t_max;

  private:
    predicate_counters* counters_;
};

/// An end of what line and triangle share when they lie in one plane.
struct span_end {
    cutting_plane cut;
    triangle_feature name;
};

span_end end_at(const line& l, const point3& p, triangle_feature name) {
    return {l.through(p), name};
}

/// Where the line meets the segment from `right` to `left` of it, seen along `axis`. The plane
/// holds the axis, so its normal . direction is what `left` exceeds `right` by.
span_end end_between(const point3& right, const point3& left, int axis, triangle_feature name) {
    return {{right, right, left, zero, unit[static_cast<std::size_t>(axis)]}, name};
}

/// The part within the ray of a common segment, or point, of line and triangle.
std::optional<ray_contact> clipped(const line& l, const span_end& enter, const span_end& leave,
                                   triangle_feature inside) {
    const double t = l.parameter(enter.cut);
    const double t_end = l.parameter(leave.cut);
    const int leaves = l.compare(leave.cut, t_end, l.t_min);
    if (leaves < 0 || l.compare(enter.cut, t, l.t_max) > 0) return std::nullopt;
    ray_contact found{enter.name, true, t, t_end, false, enter.cut};
    if (leaves == 0) {
        found = {leave.name, true, t_end, t_end, false, leave.cut};
    } else if (l.compare(enter.cut, t, l.t_min) < 0) {
        found.at = inside;
        found.t = l.t_min;
        found.from_start = true;
    }
    found.t = std::clamp(found.t, l.t_min, l.t_max);
    found.t_end = std::clamp(found.t_end, found.t, l.t_max);
    return found;
}

/// A triangle with area, and a line in its plane. With up to the left of the direction, the line
/// runs from west to east on a triangle that is seen counter-clockwise.
std::optional<ray_contact> meet_in_plane(const line& l, const triangle3& t,
                                         const detail::geometry::view_axis& view) {
    const auto [axis, turn] = view;
    const signs side{l.side_of(t[0], axis), l.side_of(t[1], axis), l.side_of(t[2], axis)};
    if (side[0] != 0 && side[0] == side[1] && side[1] == side[2]) return std::nullopt;
    const detail::geometry::plane_interval& ends =
        detail::geometry::plane_intervals[detail::geometry::side_key(side)];
    const auto end_of = [&, seen_along = axis](const detail::geometry::interval_end& end) {
        if (detail::geometry::is_corner(end.name))
            return end_at(l, at(t, detail::geometry::index_of(end.name)), end.name);
        return end_between(at(t, end.below), at(t, end.above), seen_along, end.name);
    };
    const span_end west = end_of(ends.west);
    const span_end east = end_of(ends.east);
    return turn > 0 ? clipped(l, west, east, ends.inside) : clipped(l, east, west, ends.inside);
}

/// A segment, or a point, that lies in one plane with the line. The vectors direction x (from -
/// origin) and direction x (to - origin) are multiples of one vector, the plane's normal, and both
/// zero only on the line.
std::optional<ray_contact> meet_segment(const line& l, const detail::geometry::named_segment& s) {
    for (const int axis : {0, 1, 2}) {
        const int from = l.side_of(s.from, axis);
        const int to = l.side_of(s.to, axis);
        if (from == 0 && to == 0) continue;
        if (from == to) return std::nullopt;
        const span_end end = from == 0   ? end_at(l, s.from, s.from_name)
                             : to == 0   ? end_at(l, s.to, s.to_name)
                             : from < to ? end_between(s.from, s.to, axis, s.inside)
                                         : end_between(s.to, s.from, axis, s.inside);
        return clipped(l, end, end, end.name);
    }
    const span_end from = end_at(l, s.from, s.from_name);
    const span_end to = end_at(l, s.to, s.to_name);
    bool forward = true;  // lexicographic order is that along the line, one way or the other
    for (std::size_t k = 3; k-- > 0;)
        if (magnitude_bits(l.direction[k]) != 0) forward = !std::signbit(l.direction[k]);
    return forward ? clipped(l, from, to, s.inside) : clipped(l, to, from, s.inside);
}

/// The earlier of two contacts, up to the end of the later.
std::optional<ray_contact> joined(const ray3& ray, const std::optional<ray_contact>& a,
                                  const std::optional<ray_contact>& b,
                                  predicate_counters* counters) {
    if (!a || !b) return a ? a : b;
    ray_contact first = compare(ray, *a, *b, counters) <= 0 ? *a : *b;
    first.t_end = std::max(a->t_end, b->t_end);
    return first;
}

std::optional<ray_contact> meet_flat(const ray3& ray, const line& l, const triangle3& t,
                                     predicate_counters* counters) {
    const detail::geometry::flat_triangle flat = detail::geometry::flatten(t);
    const auto first = meet_segment(l, flat.parts[0]);
    if (flat.part_count == 1) return first;
    return joined(ray, first, meet_segment(l, flat.parts[1]), counters);
}

}  // namespace

std::optional<ray_contact> intersect(const ray3& ray, const triangle3& triangle,
                                     predicate_counters* counters) {
    const auto& [a, b, c] = triangle;
    const line l(ray, counters);
    if (!(l.t_min <= l.t_max)) return std::nullopt;
    signs about{l.passes(a, b), l.passes(b, c), 0};
    if (about[0] * about[1] < 0) return std::nullopt;
    about[2] = l.passes(c, a);
    // The three values add up to normal . direction; all zero, every edge is coplanar with the
    // line.
    if (about == signs{0, 0, 0}) {
        const auto view = detail::geometry::find_view_axis(triangle, counters);
        return view ? meet_in_plane(l, triangle, *view) : meet_flat(ray, l, triangle, counters);
    }
    const std::optional<triangle_feature> name = detail::geometry::locate(about);
    if (!name) return std::nullopt;
    const bool along_normal = about[0] > 0 || about[1] > 0 || about[2] > 0;
    const point3& base =
        detail::geometry::is_corner(*name) ? at(triangle, detail::geometry::index_of(*name)) : a;
    const cutting_plane cut =
        along_normal ? cutting_plane{base, a, b, a, c} : cutting_plane{base, a, c, a, b};
    const double t = l.parameter(cut);
    if (l.compare(cut, t, l.t_min) < 0 || l.compare(cut, t, l.t_max) > 0) return std::nullopt;
    const double inside = std::clamp(t, l.t_min, l.t_max);
    return ray_contact{*name, false, inside, inside, false, cut};
}

int compare(const ray3& ray, const ray_contact& a, const ray_contact& b,
            predicate_counters* counters) {
    const line l(ray, counters);
    if (a.from_start && b.from_start) return 0;
    if (a.from_start) return -l.compare(b.entry, b.t, l.t_min);
    if (b.from_start) return l.compare(a.entry, a.t, l.t_min);
    return compare_parameters(a.t, b.t, std::max(std::abs(a.t), std::abs(b.t)), [&] {
        return compare_cuts(l.origin, l.direction, a.entry, b.entry, counters);
    });
}

}  // namespace treeform
