#pragma once
/// \file
/// Conditions on vertex properties in the terms of `weld_points`.

#include <libmesh/weld/vertex_values.hpp>
#include <treeform/mesh/weld_mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::weld {

/// Conditions as kinds, for those of tolerance 0, and as questions, for the others.
class conditions {
  public:
    /// `takes_part` is [V], 0 for points that stay alone, or empty. `kind` of `options.points`
    /// must live as long as this.
    ///
    /// \throws std::invalid_argument as `weld_mesh`
    conditions(points_view points, const attributes& properties, const mesh_weld_options& options,
               std::span<const std::uint8_t> takes_part);

    /// \pre this stays where it is while the options are used
    [[nodiscard]] weld_options options() const;

  private:
    struct question {
        vertex_values values;
        double tolerance;
    };

    [[nodiscard]] bool agree(std::uint32_t i, std::uint32_t j) const;

    weld_options given_;
    std::vector<std::uint32_t> kind_;  ///< [V], or empty when what was given is all there is
    std::vector<question> questions_;
};

}  // namespace treeform::detail::weld
