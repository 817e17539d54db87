#pragma once
/// \file
/// The length of a vector, without overflow or underflow in intermediate results.

#include <treeform/mesh/mesh.hpp>

#include <cmath>

namespace treeform::detail::place {

[[nodiscard]] inline double length_of(const point3& v) { return std::hypot(v.x, v.y, v.z); }

}  // namespace treeform::detail::place
