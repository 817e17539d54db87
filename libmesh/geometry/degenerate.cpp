#include <libmesh/geometry/degenerate.hpp>
#include <libmesh/geometry/features.hpp>
#include <libmesh/geometry/flat_triangle.hpp>
#include <libmesh/geometry/signs.hpp>
#include <treeform/mesh/predicates.hpp>

#include <span>

namespace treeform::detail::geometry {
namespace {

std::span<const named_segment> parts_of(const flat_triangle& t) {
    return std::span(t.parts).first(static_cast<std::size_t>(t.part_count));
}

std::optional<triangle_feature> locate_on_line(const point3& p, const named_segment& s) {
    if (equal_points(p, s.from)) return s.from_name;
    if (equal_points(p, s.to)) return s.to_name;
    const bool between = lexicographically_less(s.from, p) == lexicographically_less(p, s.to);
    return between ? std::optional(s.inside) : std::nullopt;
}

/// Contacts of two segments, points included, of one plane that is not parallel to `axis`. With
/// all four ends on one line any axis will do.
void meet_in_plane(int axis, const named_segment& s, const named_segment& t, contact_list& ends,
                   predicate_counters* counters) {
    const int from_about_t = orient2d(axis, t.from, t.to, s.from, counters);
    const int to_about_t = orient2d(axis, t.from, t.to, s.to, counters);
    if (from_about_t * to_about_t > 0) return;
    const int from_about_s = orient2d(axis, s.from, s.to, t.from, counters);
    const int to_about_s = orient2d(axis, s.from, s.to, t.to, counters);
    if (from_about_s * to_about_s > 0) return;
    if (from_about_t == 0 && to_about_t == 0 && from_about_s == 0 && to_about_s == 0) {
        if (const auto name = locate_on_line(s.from, t)) ends.add(s.from_name, *name);
        if (const auto name = locate_on_line(s.to, t)) ends.add(s.to_name, *name);
        if (const auto name = locate_on_line(t.from, s)) ends.add(*name, t.from_name);
        if (const auto name = locate_on_line(t.to, s)) ends.add(*name, t.to_name);
        return;
    }
    const auto name = [](const named_segment& on, int from_side, int to_side) {
        return from_side == 0 ? on.from_name : to_side == 0 ? on.to_name : on.inside;
    };
    ends.add(name(s, from_about_t, to_about_t), name(t, from_about_s, to_about_s));
}

/// An axis along which the ends of `s` and `t` do not fall on one line, or 0 when they are on one
/// line in space.
/// \pre the four ends are coplanar
int common_axis(const named_segment& s, const named_segment& t, predicate_counters* counters) {
    for (const int axis : {0, 1, 2})
        if (orient2d(axis, s.from, s.to, t.from, counters) != 0 ||
            orient2d(axis, s.from, s.to, t.to, counters) != 0 ||
            orient2d(axis, t.from, t.to, s.from, counters) != 0)
            return axis;
    return 0;
}

struct plane_side {
    int from = 0;
    int to = 0;
};

/// Contacts of a segment that reaches the plane of `t` without lying in it.
void meet_through_plane(const named_segment& s, plane_side side, const triangle3& t,
                        contact_list& ends, predicate_counters* counters) {
    const auto on_t = locate({orient3d(s.from, s.to, t[0], t[1], counters),
                              orient3d(s.from, s.to, t[1], t[2], counters),
                              orient3d(s.from, s.to, t[2], t[0], counters)});
    if (!on_t) return;
    ends.add(side.from == 0 ? s.from_name : side.to == 0 ? s.to_name : s.inside, *on_t);
}

std::optional<triangle_feature> locate_in_plane(const point3& p, const triangle3& t, int axis,
                                                predicate_counters* counters) {
    return locate({orient2d(axis, t[0], t[1], p, counters), orient2d(axis, t[1], t[2], p, counters),
                   orient2d(axis, t[2], t[0], p, counters)});
}

named_segment edge_of(const triangle3& t, int i) {
    return {t[static_cast<std::size_t>(i)], t[static_cast<std::size_t>(next(i))], corner(i),
            corner(next(i)), edge(i)};
}

/// Contacts of a segment in the plane of `t`.
void meet_within_plane(const named_segment& s, const triangle3& t, int axis, contact_list& ends,
                       predicate_counters* counters) {
    if (const auto on_t = locate_in_plane(s.from, t, axis, counters)) ends.add(s.from_name, *on_t);
    if (const auto on_t = locate_in_plane(s.to, t, axis, counters)) ends.add(s.to_name, *on_t);
    for (const int i : {0, 1, 2}) meet_in_plane(axis, s, edge_of(t, i), ends, counters);
}

triangle_contact meet(const flat_triangle& a, const flat_triangle& b,
                      predicate_counters* counters) {
    contact_list ends;
    const bool coplanar = orient3d(a.from(), a.to(), b.from(), b.to(), counters) == 0;
    if (!coplanar) return contact_of(ends, false);
    for (const named_segment& s : parts_of(a))
        for (const named_segment& t : parts_of(b))
            meet_in_plane(common_axis(s, t, counters), s, t, ends, counters);
    // Parts that overlap on one line also meet at the cuts, which may lie between the ends.
    if (ends.size() > 2)
        ends.drop_if([&](feature_pair c) {
            return (a.is_cut_at(c.on_a) && !b.ends_at(c.on_b)) ||
                   (b.is_cut_at(c.on_b) && !a.ends_at(c.on_a));
        });
    return contact_of(ends, true);
}

triangle_contact meet(const flat_triangle& a, const triangle3& b, view_axis of_b,
                      predicate_counters* counters) {
    contact_list ends;
    bool coplanar = true;
    for (const named_segment& s : parts_of(a)) {
        const plane_side side{orient3d(b[0], b[1], b[2], s.from, counters),
                              orient3d(b[0], b[1], b[2], s.to, counters)};
        if (side.from == 0 && side.to == 0) {
            meet_within_plane(s, b, of_b.axis, ends, counters);
            continue;
        }
        coplanar = false;
        if (side.from * side.to <= 0) meet_through_plane(s, side, b, ends, counters);
    }
    if (ends.size() > 2) ends.drop_if([&](feature_pair c) { return a.is_cut_at(c.on_a); });
    return contact_of(ends, coplanar);
}

triangle_contact mirrored(triangle_contact c) {
    for (std::size_t i = 0; i < c.count; ++i) c.ends[i] = {c.ends[i].on_b, c.ends[i].on_a};
    return c;
}

}  // namespace

triangle_contact intersect_degenerate(const triangle3& a, const std::optional<view_axis>& of_a,
                                      const triangle3& b, const std::optional<view_axis>& of_b,
                                      predicate_counters* counters) {
    if (of_a) return mirrored(meet(flatten(b), a, *of_a, counters));
    if (of_b) return meet(flatten(a), b, *of_b, counters);
    return meet(flatten(a), flatten(b), counters);
}

}  // namespace treeform::detail::geometry
