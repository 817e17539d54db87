#pragma once
/// \file
/// From the first point of each point's group to numbers of groups.

#include <cstdint>
#include <vector>

namespace treeform::detail::weld {

/// `group_of_point` comes in as the first point of each point's group, and leaves as the number of
/// the group; groups are numbered by their first points, which are returned, ascending.
[[nodiscard]] std::vector<std::uint32_t> number_groups(std::vector<std::uint32_t>& group_of_point);

}  // namespace treeform::detail::weld
