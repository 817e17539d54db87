#include <libmesh/base/point_math.hpp>
#include <libmesh/boolean/halved_space.hpp>
#include <libmesh/boolean/interval_triangle.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace treeform::detail::boolean {
namespace {

using box3 = aabb<double, 3>;
using node = halved_space::node;

/// Whether a box reaches into an undecided leaf below node `at`.
bool reaches(const std::vector<node>& nodes, std::size_t at, const box3& box) {
    for (;;) {
        const node& n = nodes[at];
        if (n.axis >= 3) return n.axis == node::undecided;
        const bool lower = box.min[n.axis] <= n.at, upper = box.max[n.axis] >= n.at;
        if (lower && upper && reaches(nodes, n.below, box)) return true;
        at = upper ? n.below + 1 : n.below;
    }
}

/// Whether corners may reach into a decided leaf below node `at`, which is `box`.
bool may_reach_decided(const std::vector<node>& nodes, std::size_t at, box3 box,
                       const interval_triangle& corners) {
    for (;;) {
        const node& n = nodes[at];
        if (n.axis == node::undecided) return false;
        if (n.axis == node::decided) return !corners.is_apart_from(box);
        const bool lower = corners.box().min[n.axis] <= n.at;
        const bool upper = corners.box().max[n.axis] >= n.at;
        if (lower && upper) {
            if (corners.is_apart_from(box)) return false;
            box3 half = box;
            half.max[n.axis] = n.at;
            if (may_reach_decided(nodes, n.below, half, corners)) return true;
        }
        (upper ? box.min : box.max)[n.axis] = n.at;
        at = upper ? n.below + 1 : n.below;
    }
}

/// A convex polygon, points of which are off by no more than `off` from some of a triangle.
///
/// A point where an edge is cut is a + t (b - a) for some t from 0 to 1: with M for the largest
/// coordinate, three roundings put it off by less than 2^-50 M from where exact numbers had, and a
/// and b are off already.
class clipped_triangle {
  public:
    explicit clipped_triangle(const std::array<box3, 3>& corners) : count_(corners.size()) {
        for (std::size_t i = 0; i < count_; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                at_[i][k] = 0.5 * corners[i].min[k] + 0.5 * corners[i].max[k];
                off_ = std::max(off_, corners[i].max[k] - corners[i].min[k]);
                rounding_ = std::max(
                    {rounding_, -0x1p-50 * corners[i].min[k], 0x1p-50 * corners[i].max[k]});
            }
    }

    /// What is on one side of a plane; empty where that is not known well enough.
    [[nodiscard]] clipped_triangle side(std::size_t axis, double at, bool upper) const {
        clipped_triangle part;
        part.rounding_ = rounding_;
        part.off_ = off_ + rounding_;
        const auto is_in = [&](const point3& p) { return upper ? p[axis] >= at : p[axis] <= at; };
        for (std::size_t i = 0; i < count_; ++i) {
            const point3 &p = at_[i], &q = at_[i + 1 == count_ ? 0 : i + 1];
            if (part.count_ + 2 > at_.size()) return {};
            if (is_in(p)) part.at_[part.count_++] = p;
            if (is_in(p) == is_in(q)) continue;
            const double t = std::clamp((at - p[axis]) / (q[axis] - p[axis]), 0.0, 1.0);
            part.at_[part.count_++] = base::plus(p, base::scaled(base::minus(q, p), t));
        }
        return part;
    }

    [[nodiscard]] bool empty() const { return count_ == 0; }
    /// Has a point of the triangle in it.
    [[nodiscard]] box3 middle() const {
        point3 sum{};
        for (std::size_t i = 0; i < count_; ++i) sum = base::plus(sum, at_[i]);
        const point3 mean = base::scaled(sum, 1.0 / static_cast<double>(count_));
        const double off =
            off_ + 16.0 * rounding_;  // of the sum, with as many points as there may be
        box3 box;
        for (std::size_t k = 0; k < 3; ++k) {
            box.min[k] = mean[k] - off;
            box.max[k] = mean[k] + off;
        }
        return box;
    }

  private:
    clipped_triangle() = default;

    std::size_t count_ = 0;
    std::array<point3, 16> at_{};
    double off_ = 0.0;
    double rounding_ = 0.0;
};

/// Calls `visit(part)` for what decided leaves below node `at` have of a triangle, until that is
/// true.
template <class Visit>
bool visit_decided(const std::vector<node>& nodes, std::size_t at, clipped_triangle part,
                   const Visit& visit) {
    for (;;) {
        const node& n = nodes[at];
        if (part.empty() || n.axis == node::undecided) return false;
        if (n.axis == node::decided) return visit(part);
        if (visit_decided(nodes, n.below, part.side(n.axis, n.at, false), visit)) return true;
        part = part.side(n.axis, n.at, true);
        at = n.below + 1;
    }
}

}  // namespace

bool halved_space::leaves_undecided(const std::array<box3, 3>& corners) const {
    if (std::ranges::any_of(corners, [&](const box3& c) { return !reaches_undecided(c); }))
        return true;
    return visit_decided(nodes, 0, clipped_triangle(corners), [&](const clipped_triangle& part) {
        return !reaches_undecided(part.middle());
    });
}

bool halved_space::reaches_undecided(const box3& part) const { return reaches(nodes, 0, part); }

bool halved_space::is_within_undecided(std::span<const box3> corners) const {
    const interval_triangle triangle(corners);
    return !may_reach_decided(nodes, 0, box, triangle);
}

}  // namespace treeform::detail::boolean
