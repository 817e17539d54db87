#pragma once
/// \file
/// The first of equal points.

#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::weld {

/// [V] The lowest-numbered point with the coordinates (-0 equals +0) and the label of each; a point
/// with a NaN coordinate equals nothing. `label` is [V] or empty.
///
/// \cost as `find_equal_points`
[[nodiscard]] std::vector<std::uint32_t> equal_firsts(points_view points,
                                                      std::span<const std::uint32_t> label);

}  // namespace treeform::detail::weld
