#pragma once
/// \file
/// The points that faces use.

#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::base {

/// The points that are corners of faces, ascending.
/// \pre  every corner is less than `point_count`
/// \cost O(V + F), 5 bytes a point
/// \same on any number of threads
[[nodiscard]] std::vector<std::uint32_t> used_points(std::size_t point_count,
                                                     std::span<const face> faces);

}  // namespace treeform::detail::base
