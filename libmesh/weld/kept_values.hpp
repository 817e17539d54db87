#pragma once
/// \file
/// What is kept of each group: a point, a place, a row of properties.

#include <treeform/mesh/weld.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::weld {

/// [G] the point that gives its properties.
///
/// \throws std::invalid_argument when `options.keep_by` is asked for and no property
[[nodiscard]] std::vector<std::uint32_t> kept_points(points_view points,
                                                     const attributes& properties,
                                                     const weld_options& options,
                                                     const point_groups& groups);

/// The points of each group.
class group_members {
  public:
    explicit group_members(const point_groups& groups);

    [[nodiscard]] std::size_t size() const { return begin_.size() - 1; }
    /// Ascending.
    [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t group) const {
        return {members_.data() + begin_[group], members_.data() + begin_[group + 1]};
    }

  private:
    std::vector<std::uint32_t> begin_;    ///< [G + 1]
    std::vector<std::uint32_t> members_;  ///< group by group
};

/// Puts the mean of each group of several in the place of what is there.
void take_means(points_view points, const group_members& members, std::vector<point3>& places);

/// The same for every column of floating-point numbers of `rows`, which are one a group; `vertices`
/// is the element they come from.
void take_means(const element& vertices, const group_members& members, element& rows);

}  // namespace treeform::detail::weld
