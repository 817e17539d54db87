#pragma once
/// \file
/// Points that are near each other become one.

#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::round {

/// [V] What each point becomes: nearest pairs first, those of `near` that are within `reach` of
/// each other become one of them, no further away; two that are held never do.
///
/// \param near     ascending
/// \param is_held  [V] 1 for points that stay themselves
[[nodiscard]] std::vector<std::uint32_t> joined_points(std::span<const point3> points,
                                                       std::span<const std::uint32_t> near,
                                                       std::span<const std::uint8_t> is_held,
                                                       double reach);

}  // namespace treeform::detail::round
