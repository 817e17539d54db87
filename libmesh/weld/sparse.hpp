#pragma once
/// \file
/// The rules by lists of pairs, for points most of which have few others within the tolerance.

#include <libmesh/weld/group_points.hpp>
#include <treeform/mesh/weld.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::weld {

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

}  // namespace treeform::detail::weld
