#pragma once
/// \file
/// Groups of points that are gone through in the order of a property.

#include <treeform/mesh/weld.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::weld {

/// [V] the points in the order that `options` asks for, or empty for that of their numbers.
///
/// \throws std::invalid_argument as `weld`
[[nodiscard]] std::vector<std::uint32_t> points_in_order(points_view points,
                                                         const attributes& properties,
                                                         const weld_options& options);

/// As `find_groups` of the points in `order`, which is not empty unless they are; in terms of the
/// points as they are numbered.
[[nodiscard]] point_groups find_groups_in_order(const char* called, points_view points,
                                                const weld_options& options,
                                                std::span<const std::uint32_t> order);

/// Makes the earliest point of each group in `order` its first.
void put_earliest_first(std::span<const std::uint32_t> order, point_groups& groups);

}  // namespace treeform::detail::weld
