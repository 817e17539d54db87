#pragma once
/// \file
/// Which points become one, for any function that promises it.

#include <treeform/mesh/weld.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstdint>

namespace treeform::detail::weld {

/// How neighbors are found. The groups are the same with each. Where a point has many others within
/// the tolerance, all ways take a short cut: kept points are looked up by cube, and chains join
/// whole cubes.
enum class neighbor_search : std::uint8_t {
    automatic,  ///< chosen from a sample of the points
    window,     ///< points sorted along a line in general position, and a window sliding over them
    cells,      ///< points sorted by cubes as wide as the tolerance
    tree        ///< self-search of a `treeform::tree`
};

/// As `group_points`, whose errors then name the function `called`.
[[nodiscard]] TREEFORM_API point_groups
find_groups(const char* called, points_view points, const weld_options& options,
            neighbor_search search = neighbor_search::automatic);

/// Groups of two points or more.
[[nodiscard]] std::uint64_t count_groups_of_several(const point_groups& groups);

}  // namespace treeform::detail::weld
