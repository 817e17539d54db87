#pragma once
/// \file
/// The rules by lists of pairs, for clouds in which most points have few others within the
/// tolerance.

#include <libmesh/weld/group_points.hpp>
#include <treeform/mesh/weld.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::weld {

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

}  // namespace treeform::detail::weld
