#pragma once
/// \file
/// The first point of each set of equal points.

#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::weld {

/// [V] For each point, the lowest-numbered point with the same coordinates (-0 equals +0) and
/// label. A point with a NaN coordinate equals only itself. `label` is [V] or empty.
///
/// \cost as `find_equal_points`
[[nodiscard]] std::vector<std::uint32_t> equal_firsts(points_view points,
                                                      std::span<const std::uint32_t> label);

}  // namespace treeform::detail::weld
