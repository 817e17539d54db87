#pragma once
/// \file
/// The rims of parts of a surface, as straight as they are meant to be.

#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::round {

using rim_side =
    std::array<std::uint32_t, 2>;  ///< from a point to a point: the part is on its left

/// What is left of sides, ascending, without those that run back and forth.
[[nodiscard]] std::vector<rim_side> without_opposites(const std::vector<rim_side>& sides);

/// How far `p` is from the straight way between two other points.
[[nodiscard]] double distance_to_edge(const point3& p, const point3& a, const point3& b);

/// Where two parts run along each other and nothing else has the points between, these go as long
/// as all of them are within `reach` of the straight way.
///
/// \param rims   of each part, without opposites; in any order afterwards
/// \param stays  [V] 1 for points that stay in any case
/// \param may    [parts] 1 for those whose rims may change
/// \source Douglas and Peucker, The Canadian Cartographer 10 (1973)
void straighten(std::vector<std::vector<rim_side>>& rims, std::span<const point3> points,
                std::vector<std::uint8_t> stays, std::span<const std::uint8_t> may, double reach);

}  // namespace treeform::detail::round
