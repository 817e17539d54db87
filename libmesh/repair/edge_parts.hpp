#pragma once
/// \file
/// Parts of a mesh, by the edges that link its faces.

#include <libmesh/repair/working_mesh.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::repair {

struct edge_tally {
    std::uint64_t border = 0;       ///< edges of one face
    std::uint64_t misoriented = 0;  ///< edges of two inconsistently oriented faces
    std::uint64_t nonmanifold = 0;  ///< edges of more than two faces
    std::uint64_t unbalanced = 0;   ///< edges whose signed face count is not zero
};

/// \same on any number of threads
[[nodiscard]] edge_tally tally_edges(const working_mesh& mesh);

/// The faces at edges whose signed face count is not zero, ascending.
///
/// \same on any number of threads
[[nodiscard]] std::vector<std::uint32_t> faces_at_unbalanced_edges(const working_mesh& mesh);

/// [F] the lowest face of each face's part. Faces with a common edge are of one part.
[[nodiscard]] std::vector<std::uint32_t> parts_by_edges(const working_mesh& mesh);

/// [F] the lowest face of each face's shell. Patches are in one shell if they meet at an edge at
/// which each of them is unbalanced. So parts that only touch along an edge, as two cubes may, are
/// two shells, and can be flipped separately.
[[nodiscard]] std::vector<std::uint32_t> shells(const working_mesh& mesh);

/// [F] the lowest face of each face's patch. Two faces are in one patch if they share an edge with
/// no third face.
[[nodiscard]] std::vector<std::uint32_t> patches(const working_mesh& mesh);

}  // namespace treeform::detail::repair
