#pragma once
/// \file
/// Grouping of points to be merged, shared by all functions that weld.

#include <treeform/mesh/weld.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstdint>

namespace treeform::detail::weld {

/// How neighbors are found. The groups do not depend on it. If points have many others within the
/// tolerance, every method switches to cubes: kept points are found by cube, and chains join whole
/// cubes.
enum class neighbor_search : std::uint8_t {
    automatic,  ///< chosen from a sample of the points
    window,     ///< points sorted along a line in general position, with a sliding window
    cells,      ///< points sorted by cubes with edges of the tolerance
    tree        ///< self-search of a `treeform::tree`
};

/// Like `group_points`, with errors that name the function `called`.
[[nodiscard]] TREEFORM_API point_groups
find_groups(const char* called, points_view points, const weld_options& options,
            neighbor_search search = neighbor_search::automatic);

/// The number of groups with at least two points.
[[nodiscard]] std::uint64_t count_groups_of_several(const point_groups& groups);

}  // namespace treeform::detail::weld
