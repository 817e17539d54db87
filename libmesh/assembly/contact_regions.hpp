#pragma once
/// \file
/// Pairs of faces that meet, by the places where they do.

#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace treeform::detail::assembly {

/// Regions by their first pair; see `contact_region`. Corners of one number are one point.
/// \pre `pairs` are of faces of `a` and `b`, ascending
[[nodiscard]] std::vector<contact_region> regions_of(mesh_view a, mesh_view b,
                                                     std::span<const face_pair> pairs,
                                                     std::size_t limit);

}  // namespace treeform::detail::assembly
