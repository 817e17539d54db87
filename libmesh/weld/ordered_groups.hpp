#pragma once
/// \file
/// Groups of points that are processed in the order of a property.

#include <treeform/mesh/weld.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::weld {

/// [V] The points in the order requested by `options`; empty: by number.
///
/// \throws std::invalid_argument as `weld`
[[nodiscard]] std::vector<std::uint32_t> points_in_order(points_view points,
                                                         const attributes& properties,
                                                         const weld_options& options);

/// Like `find_groups` with the points processed in `order`, which is empty only without points. The
/// result refers to the original point numbers.
[[nodiscard]] point_groups find_groups_in_order(const char* called, points_view points,
                                                const weld_options& options,
                                                std::span<const std::uint32_t> order);

/// Makes the point of each group that is earliest in `order` its first point.
void put_earliest_first(std::span<const std::uint32_t> order, point_groups& groups);

}  // namespace treeform::detail::weld
