#pragma once
/// \file
/// The point, position and row of properties kept for each group.

#include <treeform/mesh/weld.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::weld {

/// [G] The point whose properties each group keeps.
///
/// \throws std::invalid_argument when `options.keep_by` is set but names no property
[[nodiscard]] std::vector<std::uint32_t> kept_points(points_view points,
                                                     const attributes& properties,
                                                     const weld_options& options,
                                                     const point_groups& groups);

/// The points of each group.
class group_members {
  public:
    explicit group_members(const point_groups& groups);

    [[nodiscard]] std::size_t size() const { return begin_.size() - 1; }
    /// The points of a group, ascending.
    [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t group) const {
        return {members_.data() + begin_[group], members_.data() + begin_[group + 1]};
    }

  private:
    std::vector<std::uint32_t> begin_;    ///< [G + 1]
    std::vector<std::uint32_t> members_;  ///< group by group
};

/// Replaces the position of each group of several points by the mean of its points.
void take_means(points_view points, const group_members& members, std::vector<point3>& places);

/// The same for every floating-point column of `rows`, which has one row for each group; `vertices`
/// is the source element.
void take_means(const element& vertices, const group_members& members, element& rows);

}  // namespace treeform::detail::weld
