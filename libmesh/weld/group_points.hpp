#pragma once
/// \file
/// Grouping of points to be merged, shared by all functions that weld.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

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

/// The kept point that each point belongs to by the rule `first`; empty where there are too many
/// pairs for the search, or progress stopped it.
///
/// \pre  options.tolerance > 0
/// \cost 36 bytes a point at most, result included
[[nodiscard]] std::vector<std::uint32_t> sparse_leaders(points_view points,
                                                        const weld_options& options,
                                                        neighbor_search search);

/// The earliest point of each point's chain; empty as above.
[[nodiscard]] std::vector<std::uint32_t> sparse_chains(points_view points,
                                                       const weld_options& options,
                                                       neighbor_search search);

/// The kept point that each point belongs to by the rule `first`; empty when progress stopped it.
///
/// \cost O(V) expected, as long as `may_merge` is nearly always true: at most some 40 points
///       further apart than the tolerance fit a cube twice as wide
[[nodiscard]] std::vector<std::uint32_t> dense_leaders(points_view points,
                                                       const weld_options& options);

/// Whether `tiled_leaders` can do it, and the points are many enough: for the rule `first` without
/// labels and `may_merge`.
[[nodiscard]] bool can_be_tiled(points_view points, const weld_options& options);

/// Whether a window over the points would be so wide that listing pairs is not worth a try.
///
/// \cost O(V), a nanosecond a point
[[nodiscard]] bool is_window_wide(points_view points, double tolerance);

struct tiling {
    std::size_t points_a_tile = std::size_t{1} << 17;
    enum { if_faster, always } when = if_faster;
};

/// As `dense_leaders`: tiles of space that fit a cache are welded side by side, and their borders
/// after them (tile_weld.hpp). Empty also for a tolerance that is wide beside the tiles; and,
/// unless asked for `always`, where two tiles in the middle show that it would be slower: where
/// few points are kept, or most hang on the borders. They do where points come row by row and have
/// several others within the tolerance: whether one is kept then hangs on the row before.
///
/// \pre  the rule is `first`; no labels, no `may_merge`
///
/// \cost O(V) expected; 10 to 14 bytes a point, and 64 a point near a border
[[nodiscard]] std::vector<std::uint32_t> tiled_leaders(points_view points,
                                                       const weld_options& options,
                                                       const tiling& how = {});

/// The earliest point of each point's chain; empty when progress stopped it.
///
/// \cost O(V) expected, and what `any_match` costs (linked.hpp) for neighboring cubes that are not
///       one set by their earliest points; 20 bytes a point (36 where they are in few cells of
///       cubes), and some 50 a cube with points
[[nodiscard]] std::vector<std::uint32_t> dense_chains(points_view points,
                                                      const weld_options& options);

struct manifold_groups {
    point_groups groups;         ///< each within a group given
    std::uint64_t split_up = 0;  ///< groups given that were not left whole
};

/// Splits groups as `weld` says under `keep_manifold`: first those of equal coordinates, then
/// those of what has come of these, so that a group that must stay apart does not tear its faces
/// from each other. After `rounds` rounds of splitting, all groups of a component of the welded
/// mesh that still has a fault are split into single points.
///
/// \pre  every corner is a point, every point is in a group
/// \throws std::invalid_argument for more than 2^32 / 3 faces
/// \cost O(V + F log d) time a round for at most d edges at a point; one round where points were
///       manifold before and no face shrinks
/// \same on any number of threads
[[nodiscard]] manifold_groups split_to_manifold(mesh_view mesh, const point_groups& given,
                                                int rounds = 32);

}  // namespace treeform::detail::weld
