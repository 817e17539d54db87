#pragma once
/// \file
/// Whether a surface is a closed manifold.

#include <treeform/mesh/mesh.hpp>

namespace treeform::detail::topology {

/// Whether faces run along every edge once each way, and the faces at every point are one fan. False
/// also for a mesh with a point of more than 64 faces, of which nothing is known: looking at one
/// takes the square of their number.
///
/// \pre  every corner is a vertex
/// \cost O(V + F)
/// \same on any number of threads
[[nodiscard]] bool is_manifold(mesh_view mesh);

}  // namespace treeform::detail::topology
