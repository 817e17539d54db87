#pragma once
/// \file
/// The rules for points with any number of others within the tolerance; pairs are not listed.

#include <treeform/mesh/weld.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail::weld {

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

}  // namespace treeform::detail::weld
