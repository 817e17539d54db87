#pragma once
/// \file
/// The length of a vector, which neither overflows nor vanishes on the way.

#include <treeform/mesh/mesh.hpp>

#include <cmath>

namespace treeform::detail::place {

[[nodiscard]] inline double length_of(const point3& v) { return std::hypot(v.x, v.y, v.z); }

}  // namespace treeform::detail::place
