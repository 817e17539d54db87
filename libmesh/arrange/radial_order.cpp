#include <libmesh/arrange/radial_order.hpp>
#include <libmesh/exact/implicit_point.hpp>
#include <libmesh/exact/plane_predicates.hpp>

#include <algorithm>
#include <cmath>

namespace treeform::detail::arrange {
namespace {

/// A coordinate in which an edge runs up or down, and which of them.
struct run {
    int axis;
    int sign;  ///< 0 when the ends are one point
};

run run_of(const implicit_point& a, const implicit_point& b) {
    const auto far = [&](int axis) {
        const auto k = static_cast<std::size_t>(axis);
        return std::abs(b.center()[k] - a.center()[k]);
    };
    std::array axes{0, 1, 2};
    std::sort(axes.begin(), axes.end(), [&](int i, int j) { return far(i) > far(j); });
    for (const int axis : axes)
        if (const int sign = compare(axis, b, a); sign != 0) return {axis, sign};
    return {0, 0};
}

}  // namespace

void radial_order::collect(std::span<const face_side> sides) {
    members_.clear();
    for (const face_side side : sides) {
        const std::uint32_t cover = cut_.covers_of(face_of(side))[0].face;
        members_.push_back({plane_of(mesh_, cover), cover, side, 0});
    }
}

/// For faces in one plane: whether they lie on different sides of the edge.
bool radial_order::opposed(const member& m, const member& n) const {
    if (m.cover == n.cover) return m.sense() != n.sense();
    return normal_dot(m.plane, n.plane) * m.sense() * n.sense() < 0;
}

bool radial_order::sort(const std::array<std::uint32_t, 2>& points, std::span<face_side> sides) {
    if (sides.size() <= 2) return true;
    collect(sides);
    const run edge = run_of(cut_.point(points[0]), cut_.point(points[1]));
    if (edge.sign == 0) return false;
    // n x m is parallel to the edge, so one component tells which way it points.
    const auto turn = [&](const member& m, const member& n) {
        if (m.cover == n.cover) return 0;
        return normal_cross(edge.axis, m.plane, n.plane) * edge.sign * m.sense() * n.sense();
    };
    const member first = members_.front();
    for (std::size_t i = 1; i < members_.size(); ++i) {
        member& m = members_[i];
        const int ahead = turn(first, m);
        if (ahead == 0 && !opposed(first, m)) return false;
        m.half = ahead > 0 ? 1 : ahead == 0 ? 2 : 3;
    }
    bool distinct = true;
    std::sort(members_.begin() + 1, members_.end(), [&](const member& m, const member& n) {
        if (m.half != n.half || m.side == n.side) return m.half < n.half;
        const int ahead = turn(m, n);
        if (ahead == 0) distinct = false;
        return ahead > 0;
    });
    for (std::size_t i = 0; i < sides.size(); ++i) sides[i] = members_[i].side;
    return distinct;
}

// The half-plane's normal is e x (1, 0, 0). For a normal m of a face, perpendicular to e,
// (m x (e x (1, 0, 0))) . e = m.x |e|^2: faces with m.x > 0 are less than half a turn before the
// half-plane, those with m.x < 0 more, and 0 is just half a turn.
std::optional<face_side> radial_order::last_before_x(const point3& from, const point3& toward,
                                                     std::span<const face_side> sides) {
    collect(sides);
    const member* best = &members_.front();
    for (member& m : members_) {
        m.half = 2 - orient2d(0, m.plane.a, m.plane.b, m.plane.c) * m.sense();
        if (&m == best || m.half > best->half) continue;
        if (m.half < best->half) {
            best = &m;
            continue;
        }
        const int ahead =
            normal_turn(best->plane, m.plane, from, toward) * best->sense() * m.sense();
        if (ahead == 0) return std::nullopt;
        if (ahead > 0) best = &m;
    }
    return best->side;
}

}  // namespace treeform::detail::arrange
