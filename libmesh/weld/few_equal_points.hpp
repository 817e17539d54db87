#pragma once
/// \file
/// Finds equal points in clouds with few of them.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/weld.hpp>

#include <optional>

namespace treeform::detail::weld {

/// The groups of `find_equal_points`; empty if all points differ.
///
/// Only points whose hash has a mark in common with another point are compared: about a tenth of
/// the different ones.
///
/// \throws std::invalid_argument for more than 2^32 - 1 points
/// \cost   as `find_equal_points` for a tenth of the points, and 4 bytes a point
/// \same   on any number of threads
[[nodiscard]] std::optional<point_groups> few_equal_points(points_view points);

}  // namespace treeform::detail::weld
