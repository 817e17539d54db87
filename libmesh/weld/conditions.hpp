#pragma once
/// \file
/// Conditions on vertex properties in the terms of `group_points`.

#include <libmesh/weld/vertex_values.hpp>
#include <treeform/mesh/weld.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::weld {

/// Conditions as labels, for those of tolerance 0, and as questions, for the others.
class conditions {
  public:
    /// `asked` are on single columns and stand for `same` of `options`, whose `label` must live as
    /// long as this. `takes_part` is [V], 0 for points that stay alone, or empty.
    ///
    /// \throws std::invalid_argument as `weld`
    conditions(points_view points, const attributes& properties, const weld_options& options,
               std::span<const weld_condition> asked, std::span<const std::uint8_t> takes_part);

    /// \pre this stays where it is while the options are used
    [[nodiscard]] weld_options options() const;

  private:
    struct question {
        vertex_values values;
        double tolerance;
    };

    [[nodiscard]] bool agree(std::uint32_t i, std::uint32_t j) const;

    weld_options given_;
    std::vector<std::uint32_t> label_;  ///< [V], or empty when what was given is all there is
    std::vector<question> questions_;
};

}  // namespace treeform::detail::weld
