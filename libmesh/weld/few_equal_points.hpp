#pragma once
/// \file
/// Equal points among points that nearly all differ.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/weld.hpp>

#include <optional>

namespace treeform::detail::weld {

/// As `find_equal_points`; none where all points differ.
///
/// Only points that share the mark of their hash with another are compared, a tenth of those that
/// differ.
///
/// \throws std::invalid_argument for more than 2^32 - 1 points
/// \cost   as `find_equal_points` of a tenth of the points, and 4 bytes a point
/// \same   on any number of threads
[[nodiscard]] std::optional<point_groups> few_equal_points(points_view points);

}  // namespace treeform::detail::weld
