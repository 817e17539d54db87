#pragma once
/// \file
/// The rules where points may have any number of others within the tolerance: pairs are not listed.

#include <treeform/mesh/weld.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail::weld {

/// The kept point that each point belongs to by `weld_rule::first`; empty when progress stopped it.
///
/// \cost O(V) expected, as long as `may_merge` is nearly always true: at most some 40 points
///       further apart than the tolerance fit a cube twice as wide
[[nodiscard]] std::vector<std::uint32_t> dense_leaders(points_view points,
                                                       const weld_options& options);

/// Whether `tiled_leaders` can do it and is the fastest: for the rule `first` without labels and
/// `may_merge`, and many points, where a window over them would be wide.
///
/// \cost O(V), a nanosecond a point
[[nodiscard]] bool is_for_tiles(points_view points, const weld_options& options);

/// As `dense_leaders`: tiles of space that fit a cache are welded side by side, and their borders
/// after them (tile_weld.hpp). Empty also for a tolerance that is wide beside the tiles.
///
/// \pre  the rule is `first`; no labels, no `may_merge`
///
/// \cost O(V) expected; 10 to 14 bytes a point, and 64 a point near a border
[[nodiscard]] std::vector<std::uint32_t> tiled_leaders(points_view points,
                                                       const weld_options& options,
                                                       std::size_t points_a_tile = std::size_t{1}
                                                                                   << 16);

/// The earliest point of each point's chain; empty when progress stopped it.
///
/// \cost O(V) expected, and what `any_match` costs (linked.hpp) for neighboring cubes that are not
///       one set by their earliest points; 20 bytes a point, and some 50 a cube with points
[[nodiscard]] std::vector<std::uint32_t> dense_chains(points_view points,
                                                      const weld_options& options);

}  // namespace treeform::detail::weld
