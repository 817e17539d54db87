#pragma once
/// \file
/// Meshes that are a guess as a whole.

#include <libmesh/repair/edge_parts.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>

namespace treeform::detail::repair {

/// Whether faces disagree at so many edges of more than two that what they bound is anybody's
/// guess: half of the faces of tetrahedra, say.
[[nodiscard]] bool is_hopeless(const edge_tally& tally, std::size_t face_count);

/// Whether more than `most` pairs of faces meet for each face, so that they cut space into
/// splinters. False where `progress` asks to stop.
///
/// \cost one `self_intersections`
[[nodiscard]] bool is_tangle(mesh_view mesh, double most, const progress_callback& progress);

}  // namespace treeform::detail::repair
