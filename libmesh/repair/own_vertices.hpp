#pragma once
/// \file
/// Parts that were closed by themselves keep vertices of their own where they touch.

#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::repair {

/// Gives each closed component of `given`, by its own vertex numbers (`face_components`), vertices
/// of its own in `made`, where equal points were joined: of the corners of its faces that others
/// use, too, there will be one more for each such component but the first.
///
/// \param face_source   [F] of `made`, face of `given` or `repair_result::none`
/// \param vertex_source [V] of `made`; what is added comes after it
/// \cost  O(V + F)
/// \same  on any number of threads
void give_own_vertices(mesh_view given, mesh& made, std::span<const std::uint32_t> face_source,
                       std::vector<std::uint32_t>& vertex_source);

}  // namespace treeform::detail::repair
