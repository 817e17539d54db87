#pragma once
/// \file
/// Straightens the rims of parts of a surface.

#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::round {

using rim_side =
    std::array<std::uint32_t, 2>;  ///< from one point to another; the part is on its left

/// The sides that remain after opposite ones cancel, ascending.
[[nodiscard]] std::vector<rim_side> without_opposites(const std::vector<rim_side>& sides);

/// The distance of `p` from the segment between two other points.
[[nodiscard]] double distance_to_edge(const point3& p, const point3& a, const point3& b);

/// Where a rim separates the same two parts, and no other rim has the points in between, these are
/// removed as long as all of them are within `reach` of the segment.
///
/// \param rims   [parts] sides of each part, without opposite ones; in any order afterwards
/// \param stays  [V] 1 for points that must not be removed
/// \param may    [parts] 1 for parts whose rims may change
/// \source Douglas and Peucker, The Canadian Cartographer 10 (1973)
void straighten(std::vector<std::vector<rim_side>>& rims, std::span<const point3> points,
                std::vector<std::uint8_t> stays, std::span<const std::uint8_t> may, double reach);

}  // namespace treeform::detail::round
