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

/// [V] The kept point that represents each point by the rule `first`; empty when there are too many
/// pairs for the search, or when cancelled.
///
/// \pre  options.tolerance > 0
/// \cost 36 bytes a point at most, result included
[[nodiscard]] std::vector<std::uint32_t> sparse_leaders(points_view points,
                                                        const weld_options& options,
                                                        neighbor_search search);

/// [V] The earliest point of the chain of each point; empty as for `sparse_leaders`.
[[nodiscard]] std::vector<std::uint32_t> sparse_chains(points_view points,
                                                       const weld_options& options,
                                                       neighbor_search search);

/// [V] The kept point that represents each point by the rule `first`; empty when cancelled.
///
/// \cost O(V) expected if `may_merge` is nearly always true: at most about 40 points farther apart
///       than the tolerance fit into a cube twice as wide as it
[[nodiscard]] std::vector<std::uint32_t> dense_leaders(points_view points,
                                                       const weld_options& options);

/// Whether `tiled_leaders` is applicable (the rule `first` without labels and `may_merge`) and
/// there are enough points.
[[nodiscard]] bool can_be_tiled(points_view points, const weld_options& options);

/// Whether a window over the points would be too wide for listing pairs.
///
/// \cost O(V), a nanosecond a point
[[nodiscard]] bool is_window_wide(points_view points, double tolerance);

struct tiling {
    std::size_t points_a_tile = std::size_t{1} << 17;
    enum { if_faster, always } when = if_faster;
};

/// Like `dense_leaders`, but welds tiles of space that fit into the cache in parallel, and then
/// their borders (tile_weld.hpp). Also empty if the tolerance is large compared to the tiles.
/// Unless `when` is `always`, also empty if two tiles in the middle show that it would be slower:
/// if few points are kept, or most depend on points in other tiles. The latter occurs if points are
/// stored row by row with several others within the tolerance: whether a point is kept then depends
/// on the previous row.
///
/// \pre  the rule is `first`; no labels, no `may_merge`
///
/// \cost O(V) expected; 10 to 14 bytes a point, and 64 for each point near a border
[[nodiscard]] std::vector<std::uint32_t> tiled_leaders(points_view points,
                                                       const weld_options& options,
                                                       const tiling& how = {});

/// [V] The earliest point of the chain of each point; empty when cancelled.
///
/// \cost O(V) expected, plus `any_match` (linked.hpp) for neighboring cubes that their earliest
///       points do not join; 20 bytes a point (36 if they are in few cells of cubes), and about 50
///       a cube with points
[[nodiscard]] std::vector<std::uint32_t> dense_chains(points_view points,
                                                      const weld_options& options);

struct manifold_groups {
    point_groups groups;         ///< each is a subset of a given group
    std::uint64_t split_up = 0;  ///< number of given groups that were split
};

/// Splits groups as described for `keep_manifold` of `weld`: first groups of points with equal
/// coordinates, then groups of the results, so that a group that must be split does not separate
/// its own faces. After `rounds` rounds, all groups of a component of the welded mesh that is still
/// not manifold are split into single points.
///
/// \pre  every corner is a valid point number; every point is in a group
/// \throws std::invalid_argument for more than 2^32 / 3 faces
/// \cost O(V + F log d) time a round for at most d edges at a point; one round if points were
///       manifold before and no face collapses
/// \same on any number of threads
[[nodiscard]] manifold_groups split_to_manifold(mesh_view mesh, const point_groups& given,
                                                int rounds = 32);

}  // namespace treeform::detail::weld
