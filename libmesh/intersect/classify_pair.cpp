#include <libmesh/base/point_math.hpp>
#include <libmesh/intersect/classify_pair.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace treeform::detail::intersect {
namespace {

bool has_corner(const face& f, std::uint32_t corner) {
    return f[0] == corner || f[1] == corner || f[2] == corner;
}

/// Different corners of `a` that `b` has as well.
struct shared_corners {
    std::array<std::uint32_t, 3> ids{};
    std::size_t count = 0;

    [[nodiscard]] bool contains(std::uint32_t id) const {
        return std::find(ids.begin(), ids.begin() + count, id) != ids.begin() + count;
    }
};

shared_corners shared_by(const face& a, const face& b) {
    shared_corners shared;
    for (const std::uint32_t corner : a)
        if (has_corner(b, corner) && !shared.contains(corner)) shared.ids[shared.count++] = corner;
    return shared;
}

/// Whether `end` is one of the shared corners, on the evidence of coordinates: a corner of `a`
/// that lies there may have another number than the shared corner it coincides with.
bool is_shared(points_view points, const face& a, const feature_pair& end,
               const shared_corners& shared) {
    const auto corner = static_cast<std::size_t>(end.on_a);
    if (corner > static_cast<std::size_t>(triangle_feature::v2)) return false;
    for (std::size_t i = 0; i < shared.count; ++i)
        if (points[shared.ids[i]] == points[a[corner]]) return true;
    return false;
}

/// Whether the common set reaches beyond the shared corners, of which there are some, and the edge
/// between them.
bool reaches_beyond(points_view points, const face& a, const triangle_contact& common,
                    const shared_corners& shared) {
    if (common.count == 0) return false;
    if (common.count >= 3 || shared.count == 3) return true;
    // A convex set within a point or a segment: all its ends must be theirs.
    if (shared.count == 1 && common.count == 2) return true;
    return !std::all_of(common.ends.begin(), common.ends.begin() + common.count,
                        [&](const feature_pair& end) { return is_shared(points, a, end, shared); });
}

/// Triangles u v a and u v b: they overlap beyond the edge if and only if they are coplanar with a
/// and b on the same side of it. Nothing when a triangle is degenerate.
std::optional<bool> folds(const point3& u, const point3& v, const point3& a, const point3& b,
                          predicate_counters& counters) {
    for (int axis = 0; axis < 3; ++axis)
        if (const int side = orient2d(axis, u, v, a, &counters); side != 0) {
            const int other = orient2d(axis, u, v, b, &counters);
            if (other == 0) return std::nullopt;  // b is collinear, or the plane is not common
            return side == other;
        }
    return std::nullopt;
}

std::uint32_t corner_off(const face& f, const shared_corners& edge) {
    for (const std::uint32_t corner : f)
        if (!edge.contains(corner)) return corner;
    return f[0];  // a repeated corner: degenerate, and found so
}

/// Triangles p a1 a2 and p b1 b2 of one plane: whether the sectors they span at p have a ray in
/// common, which two sectors of less than half a turn have if and only if a bounding ray of one
/// lies in the other. Nothing when a triangle is degenerate.
std::optional<bool> sectors_meet(const point3& p, const point3* a1, const point3* a2,
                                 const point3* b1, const point3* b2, predicate_counters& counters) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto turn = [&](const point3* x, const point3* y) {
            return orient2d(axis, p, *x, *y, &counters);
        };
        const int turn_a = turn(a1, a2);
        if (turn_a == 0) continue;
        const int turn_b = turn(b1, b2);
        if (turn_b == 0) return std::nullopt;
        if (turn_a < 0) std::swap(a1, a2);
        if (turn_b < 0) std::swap(b1, b2);
        const int t11 = turn(a1, b1), t12 = turn(a1, b2), t21 = turn(a2, b1), t22 = turn(a2, b2);
        return (t11 >= 0 && t21 <= 0) || (t12 >= 0 && t22 <= 0) ||  // b1 or b2 in the sector of a
               (t11 <= 0 && t12 >= 0) || (t21 <= 0 && t22 >= 0);    // a1 or a2 in that of b
    }
    return std::nullopt;
}

/// Faces that share corner `p` only: true when they are coplanar and certainly meet nowhere else.
bool coplanar_and_apart(points_view points, const face& a, const face& b, std::uint32_t p,
                        predicate_counters& counters) {
    const auto others = [&](const face& f) {
        const std::size_t i = f[0] == p ? 0 : f[1] == p ? 1 : 2;
        return std::pair{&points[f[(i + 1) % 3]], &points[f[(i + 2) % 3]]};
    };
    const auto [a1, a2] = others(a);
    const auto [b1, b2] = others(b);
    if (orient3d(points[p], *a1, *a2, *b1, &counters) != 0) return false;
    if (orient3d(points[p], *a1, *a2, *b2, &counters) != 0) return false;
    return sectors_meet(points[p], a1, a2, b1, b2, counters) == std::optional(false);
}

}  // namespace

std::optional<pair_kind> classify_pair(points_view points, const face& a, const face& b,
                                       predicate_counters& counters) {
    const shared_corners shared = shared_by(a, b);
    // The neighbors of flat regions, which no filter decides, first and by fewer signs.
    if (shared.count == 2) {
        const point3& u = points[shared.ids[0]];
        const point3& v = points[shared.ids[1]];
        const point3& off_a = points[corner_off(a, shared)];
        const point3& off_b = points[corner_off(b, shared)];
        if (orient3d(u, v, off_a, off_b, &counters) != 0) return std::nullopt;
        if (const auto fold = folds(u, v, off_a, off_b, counters))
            return *fold ? std::optional(pair_kind::fold) : std::nullopt;
    }
    if (shared.count == 1 && coplanar_and_apart(points, a, b, shared.ids[0], counters))
        return std::nullopt;
    const triangle3 ta = base::triangle_of(points, a);
    const triangle3 tb = base::triangle_of(points, b);
    if (shared.count == 0) return classify_triangles(ta, tb, counters);
    const triangle_contact common = treeform::intersect(ta, tb, &counters);
    if (!reaches_beyond(points, a, common, shared)) return std::nullopt;
    if (collinear(ta[0], ta[1], ta[2], &counters) || collinear(tb[0], tb[1], tb[2], &counters))
        return pair_kind::degenerate;
    if (shared.count == 3) return pair_kind::duplicate;
    if (common.count >= 3) return shared.count == 2 ? pair_kind::fold : pair_kind::overlap;
    if (common.crossing) return shared.count == 1 ? pair_kind::pierce : pair_kind::crossing;
    return pair_kind::touching;
}

std::optional<pair_kind> classify_triangles(const triangle3& a, const triangle3& b,
                                            predicate_counters& counters) {
    const triangle_contact common = treeform::intersect(a, b, &counters);
    if (common.count == 0) return std::nullopt;
    if (collinear(a[0], a[1], a[2], &counters) || collinear(b[0], b[1], b[2], &counters))
        return pair_kind::degenerate;
    if (common.count >= 3) return pair_kind::overlap;
    return common.crossing ? pair_kind::crossing : pair_kind::touching;
}

}  // namespace treeform::detail::intersect
