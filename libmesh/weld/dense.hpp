#pragma once
/// \file
/// The rules where points may have any number of others within the tolerance: pairs are not listed.

#include <treeform/mesh/weld.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::weld {

/// The kept point that each point belongs to by `weld_rule::first`; empty when progress stopped it.
///
/// \cost O(V) expected, as long as `may_merge` is nearly always true: at most some 40 points
///       further apart than the tolerance fit a cube twice as wide
[[nodiscard]] std::vector<std::uint32_t> dense_leaders(points_view points,
                                                       const weld_options& options);

/// The earliest point of each point's chain.
[[nodiscard]] std::vector<std::uint32_t> dense_chains(points_view points,
                                                      const weld_options& options);

}  // namespace treeform::detail::weld
