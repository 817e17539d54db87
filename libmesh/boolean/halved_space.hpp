#pragma once
/// \file
/// A box that is recursively halved into boxes that are decided or undecided.

#include <treeform/tree/aabb.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

struct halved_space {
    /// A box of the division: a leaf, or a box halved at coordinate `at` of `axis`.
    struct node {
        static constexpr std::uint8_t decided = 3, undecided = 4;
        std::uint8_t axis = decided;
        double at = 0.0;
        std::uint32_t below = 0;  ///< the lower half; the upper one is next
    };

    aabb<double, 3> box{};
    std::vector<node> nodes{};  ///< the first is the whole box

    /// Whether some point of a box is in an undecided box.
    [[nodiscard]] bool reaches_undecided(const aabb<double, 3>& part) const;
    /// Whether all points of a triangle or segment, whose corners are known to lie in these boxes,
    /// are in undecided boxes. Conservative: may be false although it is the case.
    [[nodiscard]] bool is_within_undecided(std::span<const aabb<double, 3>> corners) const;
    /// Whether some point of a triangle, whose corners are known to lie in these boxes, is in no
    /// undecided box. Conservative: may be false although it is the case.
    [[nodiscard]] bool leaves_undecided(const std::array<aabb<double, 3>, 3>& corners) const;
};

}  // namespace treeform::detail::boolean
