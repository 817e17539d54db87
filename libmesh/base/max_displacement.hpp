#pragma once
/// \file
/// The largest displacement of points.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>

namespace treeform::detail {

/// The largest difference of a coordinate between `placed` and `points` transformed by `by`;
/// computed in twice the precision of double. Infinite if a number is not finite.
///
/// \pre `points` and `placed` have the same size
[[nodiscard]] double max_displacement(points_view points, const transform<3>& by,
                                      points_view placed);

}  // namespace treeform::detail
