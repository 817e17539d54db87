#pragma once
/// \file
/// The rules where points may have any number of others within the tolerance: pairs are not listed.

#include <treeform/mesh/weld.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail::weld {

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

}  // namespace treeform::detail::weld
