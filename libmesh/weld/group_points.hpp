#pragma once
/// \file
/// Which points become one, for any function that promises it.

#include <treeform/mesh/weld.hpp>

namespace treeform::detail::weld {

/// As `group_points`, whose errors then name the function `called`.
[[nodiscard]] point_groups find_groups(const char* called, points_view points,
                                       const weld_options& options);

/// Groups of two points or more.
[[nodiscard]] std::uint64_t count_groups_of_several(const point_groups& groups);

}  // namespace treeform::detail::weld
