#pragma once
/// \file
/// Where in space an expression has the same value throughout, and where it may have several.

#include <libmesh/boolean/halved_space.hpp>
#include <libmesh/boolean/partial_expression.hpp>
#include <libmesh/boolean/surface_components.hpp>
#include <treeform/tree/aabb.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// How far boxes are halved. The result is the same whatever these are.
struct division_limits {
    double effort = 1.0;  ///< how much may be spent on it
    /// Boxes with that few faces are not halved: to arrange those costs less.
    std::size_t faces_not_halved = 12;
    /// Nor are boxes that few components reach into, none of which can decide them alone, as in an
    /// exclusive or.
    std::size_t few_components = 8;
};

/// The box around all components, halved again and again, to boxes that are decided (one value
/// throughout, whatever the components that reach into them do there) or undecided (all others).
/// The surface of the result is in undecided boxes. Boxes are closed; what is in an undecided box
/// and a decided one, is in undecided space.
///
/// A component whose surface does not reach into a box winds around all of it equally often: that
/// is asked once, where it drops out on the way down. All that is decided is exact; only which
/// boxes are halved is a choice.
///
/// \source Trettner, Nehring-Wirxel and Kobbelt, EMBER: Exact Mesh Booleans via Efficient & Robust
///         Local Arrangements, SIGGRAPH 2022, for the subdivision and what may be dropped in it
class undecided_space {
  public:
    /// \param at_nowhere the expression where nothing is known to wind around anything
    /// \cost  O(F) for a given effort, some 30 ns for each face that halves are told apart by
    /// \same  on any number of threads
    undecided_space(const surface_components& components, const partial_expression& at_nowhere,
                    const division_limits& limits = {});

    /// Whether so much effort pays for halving the box around all components.
    [[nodiscard]] static bool is_divided(const surface_components& components,
                                         const division_limits& limits);

    /// [F] 1 for faces whose boxes reach into undecided space.
    [[nodiscard]] std::span<const std::uint8_t> is_undecided_face() const {
        return is_undecided_face_;
    }

    /// As `halved_space`.
    [[nodiscard]] bool reaches_undecided(const aabb<double, 3>& box) const {
        return halves_.reaches_undecided(box);
    }
    [[nodiscard]] bool is_within_undecided(std::span<const aabb<double, 3>> corners) const {
        return halves_.is_within_undecided(corners);
    }
    [[nodiscard]] bool leaves_undecided(const std::array<aabb<double, 3>, 3>& corners) const {
        return halves_.leaves_undecided(corners);
    }

  private:
    std::vector<std::uint8_t> is_undecided_face_{};
    halved_space halves_{};
};

}  // namespace treeform::detail::boolean
