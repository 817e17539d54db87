#pragma once
/// \file
/// Restores separate vertices of closed components that touch.

#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::repair {

/// In `made`, equal points were joined. Gives each closed component of `given` (by its vertex
/// numbers, `face_components`) its own vertices again: a vertex used by several components is
/// repeated for each of them except the first.
///
/// \param face_source   [F of `made`] face of `given`, or `repair_result::none`
/// \param vertex_source [V of `made`] extended by the added vertices
/// \cost  O(V + F)
/// \same  on any number of threads
void give_own_vertices(mesh_view given, mesh& made, std::span<const std::uint32_t> face_source,
                       std::vector<std::uint32_t>& vertex_source);

}  // namespace treeform::detail::repair
