#pragma once
/// \file
/// Detects meshes that cannot be repaired meaningfully.

#include <libmesh/repair/edge_parts.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>

namespace treeform::detail::repair {

/// Whether so many edges of three or more faces are unbalanced that the bounded solid is unclear;
/// for example, half of the faces of tetrahedra.
[[nodiscard]] bool is_hopeless(const edge_tally& tally, std::size_t face_count);

/// Whether more than `most` pairs of faces meet for each face, so that space is cut into splinters.
/// False if `progress` returned false.
///
/// \cost one `self_intersections`
[[nodiscard]] bool is_tangle(mesh_view mesh, double most, const progress_callback& progress);

}  // namespace treeform::detail::repair
