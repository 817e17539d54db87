#pragma once
/// \file
/// Points that can be computed with.

#include <treeform/mesh/mesh.hpp>

#include <algorithm>
#include <vector>

namespace treeform::detail::base {

[[nodiscard]] inline bool is_finite(const point3& p) {
    // Differences, not a sum of all: a sum may overflow.
    return p.x - p.x == 0.0 && p.y - p.y == 0.0 && p.z - p.z == 0.0;
}

[[nodiscard]] inline bool all_finite(const std::vector<point3>& points) {
    return std::all_of(points.begin(), points.end(), is_finite);
}

}  // namespace treeform::detail::base
