#pragma once
/// \file
/// Where in space an expression has the same value throughout, and where it may have several.

#include <libmesh/boolean/partial_expression.hpp>
#include <libmesh/boolean/surface_components.hpp>
#include <treeform/tree/aabb.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// The box around all components, halved again and again, to boxes that are settled (one value
/// throughout, whatever the components that reach into them do there) or active (all others).
/// The surface of the result is in active boxes. Boxes are closed; what is in an active box and a
/// settled one, is in active space.
///
/// A component whose surface does not reach into a box winds around all of it equally often: that is
/// asked once, where it drops out on the way down. All that is decided is exact; only which boxes
/// are halved is a choice.
///
/// \source Trettner, Nehring-Wirxel and Kobbelt, EMBER: Exact Mesh Booleans via Efficient & Robust
///         Local Arrangements, SIGGRAPH 2022, for the subdivision and what may be dropped in it
class active_space {
  public:
    /// \param at_nowhere the expression where nothing is known to wind around anything
    /// \param effort     of halving boxes: 1, or less for a first look
    /// \cost  O(F) for a given effort, some 30 ns for each face that halves are told apart by
    /// \same  on any number of threads
    active_space(const surface_components& components, const partial_expression& at_nowhere,
                 double effort = 1.0);

    /// [F] 1 for faces whose boxes reach into active space.
    [[nodiscard]] std::span<const std::uint8_t> is_active_face() const { return is_active_face_; }

    /// Whether some point of a box is in active space.
    [[nodiscard]] bool reaches_active(const aabb<double, 3>& box) const;
    /// Whether all points of the triangle or segment are, whose corners are somewhere in these boxes.
    /// False also for some of which it is true.
    [[nodiscard]] bool is_within_active(std::span<const aabb<double, 3>> corners) const;

    /// A box of the division: a leaf, or halved where coordinate `axis` is `at`.
    struct node {
        static constexpr std::uint8_t settled = 3, active = 4;
        std::uint8_t axis = settled;
        double at = 0.0;
        std::uint32_t below = 0;  ///< the lower half; the upper one is next
    };

  private:
    std::vector<std::uint8_t> is_active_face_{};
    std::vector<node> nodes_{};  ///< the first is all
    aabb<double, 3> box_{};
};

}  // namespace treeform::detail::boolean
