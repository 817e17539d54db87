#pragma once
/// \file
/// A box that is halved again and again, to boxes that are settled or active.

#include <treeform/tree/aabb.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

struct halved_space {
    /// A box of the division: a leaf, or halved where coordinate `axis` is `at`.
    struct node {
        static constexpr std::uint8_t settled = 3, active = 4;
        std::uint8_t axis = settled;
        double at = 0.0;
        std::uint32_t below = 0;  ///< the lower half; the upper one is next
    };

    aabb<double, 3> box{};
    std::vector<node> nodes{};  ///< the first is all of the box

    /// Whether some point of a part is in an active one.
    [[nodiscard]] bool reaches_active(const aabb<double, 3>& part) const;
    /// Whether all points of the triangle or segment are, whose corners are somewhere in these boxes.
    /// False also for some of which it is true.
    [[nodiscard]] bool is_within_active(std::span<const aabb<double, 3>> corners) const;
    /// Whether some point of a triangle is in no active one, whose corners are somewhere in these
    /// boxes. False also for some of which it is true.
    [[nodiscard]] bool leaves_active(const std::array<aabb<double, 3>, 3>& corners) const;
};

}  // namespace treeform::detail::boolean
