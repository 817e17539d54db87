#pragma once
/// \file
/// A box that is halved again and again, to boxes that are decided or undecided.

#include <treeform/tree/aabb.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

struct halved_space {
    /// A box of the division: a leaf, or halved where coordinate `axis` is `at`.
    struct node {
        static constexpr std::uint8_t decided = 3, undecided = 4;
        std::uint8_t axis = decided;
        double at = 0.0;
        std::uint32_t below = 0;  ///< the lower half; the upper one is next
    };

    aabb<double, 3> box{};
    std::vector<node> nodes{};  ///< the first is all of the box

    /// Whether some point of a part is in an undecided one.
    [[nodiscard]] bool reaches_undecided(const aabb<double, 3>& part) const;
    /// Whether all points of the triangle or segment are, whose corners are somewhere in these
    /// boxes. False also for some of which it is true.
    [[nodiscard]] bool is_within_undecided(std::span<const aabb<double, 3>> corners) const;
    /// Whether some point of a triangle is in no undecided one, whose corners are somewhere in
    /// these boxes. False also for some of which it is true.
    [[nodiscard]] bool leaves_undecided(const std::array<aabb<double, 3>, 3>& corners) const;
};

}  // namespace treeform::detail::boolean
