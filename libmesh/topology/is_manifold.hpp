#pragma once
/// \file
/// Tests whether a surface is a closed manifold.

#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::topology {

/// The points, ascending, whose faces are not a single closed fan, in which consecutive faces share
/// an edge with no other face. Includes all points with more than 64 faces, which are not tested,
/// since a test takes quadratic time. Faces with a repeated corner are ignored.
///
/// \pre  every corner is a valid vertex number
/// \cost O(V + F)
/// \same on any number of threads
[[nodiscard]] std::vector<std::uint32_t> points_without_fan(mesh_view mesh);

/// Whether every edge has exactly one face in each direction, and the faces at every point are a
/// single fan. Also false if a point has more than 64 faces.
///
/// \pre  every corner is a valid vertex number
/// \cost O(V + F)
/// \same on any number of threads
[[nodiscard]] bool is_manifold(mesh_view mesh);

/// The same for the edges and fans at the given points only. Also false if one of these has more
/// than 64 faces. `points` may have duplicates.
[[nodiscard]] bool is_manifold_at(std::span<const std::uint32_t> points, mesh_view mesh);

}  // namespace treeform::detail::topology
