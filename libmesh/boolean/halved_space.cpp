#include <libmesh/base/point_math.hpp>
#include <libmesh/boolean/halved_space.hpp>
#include <treeform/mesh/mesh.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace treeform::detail::boolean {
namespace {

using box3 = aabb<double, 3>;
using node = halved_space::node;

/// Whether a box reaches into an active leaf below node `at`.
bool reaches(const std::vector<node>& nodes, std::size_t at, const box3& box) {
    for (;;) {
        const node& n = nodes[at];
        if (n.axis >= 3) return n.axis == node::active;
        const bool lower = box.min[n.axis] <= n.at, upper = box.max[n.axis] >= n.at;
        if (lower && upper && reaches(nodes, n.below, box)) return true;
        at = upper ? n.below + 1 : n.below;
    }
}

/// A triangle or a segment, whose corners are off by no more than `off` along each axis.
class rough_corners {
  public:
    explicit rough_corners(std::span<const box3> corners) : corners_(corners) {
        for (const box3& corner : corners) all_.include(corner);
    }

    [[nodiscard]] const box3& box() const { return all_; }

    /// Whether it is certain that a box has no point of them. Any axis may tell them apart; where
    /// projections to it are rounded, each of three products and two sums is off by 2^-53 of itself,
    /// and the difference from the middle by 2^-52 of the larger coordinate.
    [[nodiscard]] bool is_apart_from(const box3& box) {
        if (axes_ == 0) find_axes();
        point3 middle, half;
        double largest = largest_;
        for (std::size_t k = 0; k < 3; ++k) {
            middle[k] = 0.5 * box.min[k] + 0.5 * box.max[k];
            half[k] = 0.5 * box.max[k] - 0.5 * box.min[k];
            largest = std::max({largest, std::abs(box.min[k]), std::abs(box.max[k])});
        }
        const double off = off_ + 0x1p-48 * largest;
        for (std::size_t a = 0; a < axes_; ++a) {
            const point3& axis = axis_[a];
            const point3 size = {std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)};
            const double reach = base::dot(size, half) + off * (size.x + size.y + size.z);
            bool is_above = true, is_below = true;
            for (std::size_t i = 0; i < corners_.size(); ++i) {
                const double at = base::dot(axis, base::minus(at_[i], middle));
                is_above = is_above && at > reach;
                is_below = is_below && at < -reach;
            }
            if (is_above || is_below) return true;
        }
        return false;
    }

  private:
    void find_axes() {
        const std::size_t count = corners_.size();
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                at_[i][k] = 0.5 * corners_[i].min[k] + 0.5 * corners_[i].max[k];
                off_ = std::max(off_, corners_[i].max[k] - corners_[i].min[k]);
                largest_ = std::max({largest_, std::abs(all_.min[k]), std::abs(all_.max[k])});
            }
        if (count == 3)
            add_axis(base::cross(base::minus(at_[1], at_[0]), base::minus(at_[2], at_[0])));
        for (std::size_t i = 0; i < count; ++i) {
            const point3 edge = base::minus(at_[(i + 1) % count], at_[i]);
            add_axis({0.0, -edge.z, edge.y});
            add_axis({edge.z, 0.0, -edge.x});
            add_axis({-edge.y, edge.x, 0.0});
        }
    }
    void add_axis(const point3& axis) { axis_[axes_++] = axis; }

    std::span<const box3> corners_;
    box3 all_{};
    // Found where boxes do not do.
    std::array<point3, 3> at_{};
    double off_ = 0.0;
    double largest_ = 0.0;
    std::array<point3, 10> axis_{};
    std::size_t axes_ = 0;
};

/// Whether corners may reach into a settled leaf below node `at`, which is `box`.
bool may_reach_settled(const std::vector<node>& nodes, std::size_t at, box3 box,
                       rough_corners& corners) {
    for (;;) {
        const node& n = nodes[at];
        if (n.axis == node::active) return false;
        if (n.axis == node::settled) return !corners.is_apart_from(box);
        const bool lower = corners.box().min[n.axis] <= n.at;
        const bool upper = corners.box().max[n.axis] >= n.at;
        if (lower && upper) {
            box3 half = box;
            half.max[n.axis] = n.at;
            if (may_reach_settled(nodes, n.below, half, corners)) return true;
        }
        (upper ? box.min : box.max)[n.axis] = n.at;
        at = upper ? n.below + 1 : n.below;
    }
}

}  // namespace

bool halved_space::reaches_active(const box3& part) const { return reaches(nodes, 0, part); }

bool halved_space::is_within_active(std::span<const box3> corners) const {
    rough_corners rough(corners);
    return !may_reach_settled(nodes, 0, box, rough);
}

}  // namespace treeform::detail::boolean
