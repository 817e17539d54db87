#pragma once
/// \file
/// Numbers groups of points by their first points.

#include <cstdint>
#include <vector>

namespace treeform::detail::weld {

/// Replaces, in `group_of_point`, the first point of the group of each point by the number of the
/// group. Groups are numbered in the order of their first points, which are returned, ascending.
[[nodiscard]] std::vector<std::uint32_t> number_groups(std::vector<std::uint32_t>& group_of_point);

}  // namespace treeform::detail::weld
