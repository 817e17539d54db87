#include <libmesh/geometry/coplanar.hpp>
#include <libmesh/geometry/features.hpp>
#include <libmesh/geometry/signs.hpp>

#include <utility>

namespace treeform::detail::geometry {
namespace {

/// [corner of the one][edge of the other]: +1 inside, 0 on, -1 outside of the edge's line.
using side_table = std::array<std::array<int, 3>, 3>;

using triangle2 = std::array<point2, 3>;

triangle2 seen_along(int axis, const triangle3& t) {
    const auto seen = [axis](const point3& p) {
        const auto [x, y] = exact::projection(axis, p);
        return point2{x, y};
    };
    return {seen(t[0]), seen(t[1]), seen(t[2])};
}

/// `turn` is the orientation of `about`.
side_table sides(const triangle2& of, const triangle2& about, int turn,
                 predicate_counters* counters) {
    side_table table;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t edge = 0; edge < 3; ++edge)
            table[i][edge] =
                turn * orient2d_sign(about[edge], about[(edge + 1) % 3], of[i], counters);
    return table;
}

/// Whether an edge of the other triangle has all corners strictly outside.
bool separated(const side_table& table) {
    for (std::size_t edge = 0; edge < 3; ++edge)
        if (table[0][edge] < 0 && table[1][edge] < 0 && table[2][edge] < 0) return true;
    return false;
}

/// The extreme points of the common set: corners of either triangle that lie in the other, and
/// points where two edges cross. Edges that overlap end in corners.
contact_list extreme_points(const side_table& a_about_b, const side_table& b_about_a) {
    contact_list points;
    for (int i = 0; i < 3; ++i)
        if (const auto on_b = locate(a_about_b[static_cast<std::size_t>(i)]))
            points.add(corner(i), *on_b);
    for (int j = 0; j < 3; ++j)
        if (const auto on_a = locate(b_about_a[static_cast<std::size_t>(j)]))
            points.add(*on_a, corner(j));
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            if (a_about_b[i][j] * a_about_b[(i + 1) % 3][j] < 0 &&
                b_about_a[j][i] * b_about_a[(j + 1) % 3][i] < 0)
                points.add(edge(static_cast<int>(i)), edge(static_cast<int>(j)));
    return points;
}

/// Whether `p` comes before `q` on the walk along edge `i` of `a`, which holds both.
/// `same_turn` says that both triangles run the same way around.
bool comes_first(int i, feature_pair p, feature_pair q, const side_table& a_about_b,
                 bool same_turn) {
    if (p.on_a == corner(i) || q.on_a == corner(next(i))) return true;
    if (q.on_a == corner(i) || p.on_a == corner(next(i))) return false;
    // Where the walk crosses an edge of b it enters if it began outside.
    const auto& start = a_about_b[static_cast<std::size_t>(i)];
    if (is_edge(p.on_b)) return start[static_cast<std::size_t>(index_of(p.on_b))] < 0;
    if (is_edge(q.on_b)) return start[static_cast<std::size_t>(index_of(q.on_b))] > 0;
    // Two corners of b: its edge lies on this one, with the area on the same side of both.
    return (next(index_of(p.on_b)) == index_of(q.on_b)) == same_turn;
}

bool on_one_edge(int i, triangle_feature f, triangle_feature g) {
    return holds(i, f) && holds(i, g);
}

/// Two corners of an area are neighbors when an edge of either triangle holds both: the area
/// lies on one side of that edge.
bool neighbors(feature_pair p, feature_pair q) {
    for (int i = 0; i < 3; ++i)
        if (on_one_edge(i, p.on_a, q.on_a) || on_one_edge(i, p.on_b, q.on_b)) return true;
    return false;
}

/// Two successive corners of an area, by number, counter-clockwise as `a` runs.
std::pair<int, int> first_side(const contact_list& corners, const side_table& a_about_b,
                               bool same_turn) {
    for (int i = 0; i < 3; ++i)
        for (int p = 0; p < corners.size(); ++p)
            for (int q = p + 1; q < corners.size(); ++q)
                if (on_one_edge(i, corners[p].on_a, corners[q].on_a))
                    return comes_first(i, corners[p], corners[q], a_about_b, same_turn)
                               ? std::pair{p, q}
                               : std::pair{q, p};
    // No side lies on an edge of a, so all lie on edges of b: the area is b.
    const triangle_feature second = same_turn ? triangle_feature::v1 : triangle_feature::v2;
    std::pair<int, int> side{0, 0};
    for (int p = 0; p < corners.size(); ++p) {
        if (corners[p].on_b == triangle_feature::v0) side.first = p;
        if (corners[p].on_b == second) side.second = p;
    }
    assert(side.first != side.second);
    return side;
}

/// The corners of an area counter-clockwise as `a` runs: a first side, then neighbor by neighbor.
contact_list counter_clockwise(const contact_list& corners, std::pair<int, int> side) {
    contact_list ordered;
    ordered.add(corners[side.first].on_a, corners[side.first].on_b);
    unsigned seen = 1U << side.first;
    const auto unseen_neighbor = [&](int p) {
        for (int q = 0; q < corners.size(); ++q)
            if ((seen >> q & 1U) == 0 && neighbors(corners[p], corners[q])) return q;
        return -1;
    };
    for (int last = side.second; last >= 0; last = unseen_neighbor(last)) {
        ordered.add(corners[last].on_a, corners[last].on_b);
        seen |= 1U << last;
    }
    assert(ordered.size() == corners.size());
    return ordered;
}

}  // namespace

triangle_contact intersect_coplanar(const triangle3& a, view_axis of_a, const triangle3& b,
                                    predicate_counters* counters) {
    const triangle2 flat_a = seen_along(of_a.axis, a);
    const triangle2 flat_b = seen_along(of_a.axis, b);
    const int turn_of_b = orient2d_sign(flat_b[0], flat_b[1], flat_b[2], counters);
    assert(of_a.turn != 0 && turn_of_b != 0);
    triangle_contact apart;
    apart.coplanar = true;
    const side_table a_about_b = sides(flat_a, flat_b, turn_of_b, counters);
    if (separated(a_about_b)) return apart;
    const side_table b_about_a = sides(flat_b, flat_a, of_a.turn, counters);
    if (separated(b_about_a)) return apart;

    const contact_list points = extreme_points(a_about_b, b_about_a);
    if (points.size() < 3) return contact_of(points, true);
    const auto side = first_side(points, a_about_b, of_a.turn == turn_of_b);
    return contact_of(counter_clockwise(points, side), true);
}

}  // namespace treeform::detail::geometry
