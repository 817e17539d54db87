#pragma once
/// \file
/// Divides space into boxes in which an expression is constant, and undecided boxes.

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

/// How far boxes are halved. These limits do not affect results.
struct division_limits {
    double effort = 1.0;  ///< factor of the budget
    /// Boxes with at most this many faces are not halved, since cutting them costs less.
    std::size_t faces_not_halved = 12;
    /// Boxes with at most this many components, none of which can decide them alone (as in a
    /// symmetric difference), are not halved.
    std::size_t few_components = 8;
};

/// The box around all components, recursively halved into boxes that are decided (the expression is
/// constant, regardless of the components that reach into them) or undecided (all others). The
/// surface of the result is in undecided boxes. Boxes are closed; a point in both an undecided and
/// a decided box is in undecided space.
///
/// A component whose surface does not reach into a box has a constant winding number there, which
/// is computed once, when it drops out of the recursion. All decisions are exact; only the choice
/// of the boxes to halve is heuristic.
///
/// \source Trettner, Nehring-Wirxel and Kobbelt, EMBER: Exact Mesh Booleans via Efficient & Robust
///         Local Arrangements, SIGGRAPH 2022, for the subdivision, and for dropping decided parts
class undecided_space {
  public:
    /// \param at_nowhere the expression with all winding numbers unknown
    /// \cost  O(F) for a given effort, about 30 ns for each face that is sorted into halves
    /// \same  on any number of threads
    undecided_space(const surface_components& components, const partial_expression& at_nowhere,
                    const division_limits& limits = {});

    /// Whether the effort suffices to halve the box around all components.
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
