#pragma once
/// \file
/// Orients patches consistently at edges of more than two faces.

#include <libmesh/repair/working_mesh.hpp>

#include <cstdint>

namespace treeform::detail::repair {

/// Flips patches as long as that reduces the imbalance of the edges with more than two faces;
/// returns the number of flipped faces.
///
/// The imbalance is the sum over these edges of length times the magnitude of the signed face
/// count. The patch that reduces it most is flipped first, of several the lowest. A patch without
/// unbalanced edges is not flipped.
///
/// \pre  faces within patches are consistent (`make_faces_agree`)
/// \cost O(V + F log F), plus the neighbors of each flipped patch
/// \same on any number of threads
std::uint64_t balance_patches(working_mesh& mesh);

}  // namespace treeform::detail::repair
