#pragma once
/// \file
/// Translates conditions on vertex properties into options of `group_points`.

#include <libmesh/weld/vertex_values.hpp>
#include <treeform/mesh/weld.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::weld {

/// Conditions with a tolerance of 0 become labels; the others become a predicate on pairs of
/// points.
class conditions {
  public:
    /// `asked` replaces `options.same`, with one condition for each column. `options.label` must
    /// outlive this object. `takes_part` is [V], 0 for points that are never merged; empty: all may
    /// be.
    ///
    /// \throws std::invalid_argument as `weld`
    conditions(points_view points, const attributes& properties, const weld_options& options,
               std::span<const weld_condition> asked, std::span<const std::uint8_t> takes_part);

    /// \pre the object is not moved while the options are in use
    [[nodiscard]] weld_options options() const;

  private:
    struct question {
        vertex_values values;
        double tolerance;
    };

    [[nodiscard]] bool agree(std::uint32_t i, std::uint32_t j) const;

    weld_options given_;
    std::vector<std::uint32_t> label_;  ///< [V]; empty: use the given labels
    std::vector<question> questions_;
};

}  // namespace treeform::detail::weld
