#include <libmesh/boolean/halved_space.hpp>
#include <libmesh/boolean/rough_corners.hpp>

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

/// Whether corners may reach into a settled leaf below node `at`, which is `box`.
bool may_reach_settled(const std::vector<node>& nodes, std::size_t at, box3 box,
                       const rough_corners& corners) {
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
    const rough_corners rough(corners);
    return !may_reach_settled(nodes, 0, box, rough);
}

}  // namespace treeform::detail::boolean
