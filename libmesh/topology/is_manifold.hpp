#pragma once
/// \file
/// Whether a surface is a closed manifold.

#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::topology {

/// The points whose faces are not one closed fan, from one to the next across the edge that it has
/// in common with it alone, ascending; and those of more than 64 faces, of which nothing is known:
/// looking at one takes the square of their number. Faces with a corner twice are left out.
///
/// \pre  every corner is a vertex
/// \cost O(V + F)
/// \same on any number of threads
[[nodiscard]] std::vector<std::uint32_t> points_without_fan(mesh_view mesh);

/// Whether faces run along every edge once each way, and the faces at every point are one fan.
/// False also for a mesh with a point of more than 64 faces.
///
/// \pre  every corner is a vertex
/// \cost O(V + F)
/// \same on any number of threads
[[nodiscard]] bool is_manifold(mesh_view mesh);

/// Whether faces run along every edge at some points once each way, and the faces at each of these
/// are one fan. False also for a point of more than 64 faces. Points may be named twice.
[[nodiscard]] bool is_manifold_at(std::span<const std::uint32_t> points, mesh_view mesh);

}  // namespace treeform::detail::topology
