#pragma once
/// \file
/// Joins points that are near each other.

#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::round {

/// [V] The point that each point becomes. Points of `near` within `reach` of each other become one
/// of them, nearest pairs first, and none moves by more than `reach`; two held points are never
/// joined.
///
/// \param near     ascending
/// \param is_held  [V] 1 for points that must not change
[[nodiscard]] std::vector<std::uint32_t> joined_points(std::span<const point3> points,
                                                       std::span<const std::uint32_t> near,
                                                       std::span<const std::uint8_t> is_held,
                                                       double reach);

}  // namespace treeform::detail::round
