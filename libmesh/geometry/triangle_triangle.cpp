#include <libmesh/geometry/coplanar.hpp>
#include <libmesh/geometry/degenerate.hpp>
#include <libmesh/geometry/features.hpp>
#include <libmesh/geometry/plane_interval.hpp>
#include <libmesh/geometry/signs.hpp>
#include <libmesh/geometry/view_axis.hpp>
#include <treeform/mesh/predicates.hpp>

#include <optional>

namespace treeform {
namespace {

using detail::geometry::at;
using detail::geometry::interval_end;
using detail::geometry::plane_interval;
using signs = std::array<int, 3>;

signs sides_of_plane(const triangle3& plane, const triangle3& t, predicate_counters* counters) {
    return {detail::geometry::orient3d_sign(plane[0], plane[1], plane[2], t[0], counters),
            detail::geometry::orient3d_sign(plane[0], plane[1], plane[2], t[1], counters),
            detail::geometry::orient3d_sign(plane[0], plane[1], plane[2], t[2], counters)};
}

bool strictly_on_one_side(const signs& s) { return s[0] != 0 && s[0] == s[1] && s[1] == s[2]; }
bool all_zero(const signs& s) { return s[0] == 0 && s[1] == 0 && s[2] == 0; }
bool strictly_on_both_sides(const signs& s) {
    const bool above = s[0] > 0 || s[1] > 0 || s[2] > 0;
    const bool below = s[0] < 0 || s[1] < 0 || s[2] < 0;
    return above && below;
}

/// Two triangles whose planes meet in a line, which both reach: each cuts an interval from it.
///
/// With u the side of `a` that ends in p, taken upwards through the plane of `b`, and v that of `b`
/// that ends in q, taken upwards through the plane of `a`, orient3d(u, v) has the sign of p - q
/// along normal(b) x normal(a). That is to the east as seen on `a` and to the west as seen on `b`,
/// so the interval of `b` runs from its east end to its west end.
class line_intervals {
  public:
    line_intervals(const triangle3& a, const signs& of_a, const triangle3& b, const signs& of_b,
                   predicate_counters* counters)
        : a_(a),
          b_(b),
          on_a_(detail::geometry::plane_intervals[detail::geometry::side_key(of_a)]),
          on_b_(detail::geometry::plane_intervals[detail::geometry::side_key(of_b)]),
          counters_(counters) {}

    [[nodiscard]] detail::geometry::contact_list common() const {
        detail::geometry::contact_list ends;
        const int gap_after_a = order(on_a_.east, on_b_.east);
        if (gap_after_a < 0) return ends;
        const int gap_before_a = gap_after_a == 0 ? -1 : order(on_a_.west, on_b_.west);
        if (gap_before_a > 0) return ends;
        if (gap_after_a == 0) {
            ends.add(on_a_.east.name, on_b_.east.name);
        } else if (gap_before_a == 0) {
            ends.add(on_a_.west.name, on_b_.west.name);
        } else {
            add_inner(ends, -order(on_a_.west, on_b_.east), on_a_.west, on_b_.east);
            add_inner(ends, order(on_a_.east, on_b_.west), on_a_.east, on_b_.west);
        }
        return ends;
    }

  private:
    /// Sign of p - q on the line, for an end of `a` and one of `b`.
    [[nodiscard]] int order(const interval_end& p, const interval_end& q) const {
        return detail::geometry::orient3d_sign(at(a_, p.below), at(a_, p.above), at(b_, q.below),
                                               at(b_, q.above), counters_);
    }
    /// Adds `p` of `a` or `q` of `b`, whichever the other triangle holds: `inner` < 0 says that it
    /// is p, > 0 that it is q, and 0 that they are one point.
    void add_inner(detail::geometry::contact_list& ends, int inner, const interval_end& p,
                   const interval_end& q) const {
        ends.add(inner > 0 ? on_a_.inside : p.name, inner < 0 ? on_b_.inside : q.name);
    }

    const triangle3& a_;
    const triangle3& b_;
    const plane_interval& on_a_;
    const plane_interval& on_b_;
    predicate_counters* counters_;
};

/// For pairs of which a plane holds all corners of one triangle: coplanar, or one is degenerate.
triangle_contact intersect_flat(const triangle3& a, const triangle3& b,
                                predicate_counters* counters) {
    const std::optional<detail::geometry::view_axis> of_a =
        detail::geometry::find_view_axis(a, counters);
    const std::optional<detail::geometry::view_axis> of_b =
        detail::geometry::find_view_axis(b, counters);
    if (of_a && of_b) return detail::geometry::intersect_coplanar(a, *of_a, b, counters);
    return detail::geometry::intersect_degenerate(a, of_a, b, of_b, counters);
}

}  // namespace

triangle_contact intersect(const triangle3& a, const triangle3& b, predicate_counters* counters) {
    const signs of_b = sides_of_plane(a, b, counters);
    if (strictly_on_one_side(of_b)) return {};
    const signs of_a = sides_of_plane(b, a, counters);
    if (strictly_on_one_side(of_a)) return {};
    // A degenerate triangle spans no plane, and everything lies on it.
    if (all_zero(of_a) || all_zero(of_b)) return intersect_flat(a, b, counters);

    const line_intervals intervals(a, of_a, b, of_b, counters);
    triangle_contact result = detail::geometry::contact_of(intervals.common(), false);
    result.crossing =
        result.count == 2 && strictly_on_both_sides(of_a) && strictly_on_both_sides(of_b);
    return result;
}

}  // namespace treeform
