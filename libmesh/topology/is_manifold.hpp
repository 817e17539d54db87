#pragma once
/// \file
/// Whether a surface is a closed manifold.

#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>

namespace treeform::detail::topology {

/// Whether faces run along every edge once each way, and the faces at every point are one fan. False
/// also for a mesh with a point of more than 64 faces, of which nothing is known: looking at one
/// takes the square of their number.
///
/// \pre  every corner is a vertex
/// \cost O(V + F)
/// \same on any number of threads
[[nodiscard]] bool is_manifold(mesh_view mesh);

/// The same of the faces at some points only, and of the edges there. Points may be named twice.
[[nodiscard]] bool is_manifold_at(std::span<const std::uint32_t> points, mesh_view mesh);

}  // namespace treeform::detail::topology
