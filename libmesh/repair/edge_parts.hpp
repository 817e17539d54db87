#pragma once
/// \file
/// Parts of a mesh, by the edges that link its faces.

#include <libmesh/repair/working_mesh.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::repair {

struct edge_tally {
    std::uint64_t border = 0;       ///< edges of one face
    std::uint64_t disagreeing = 0;  ///< of two that run the same way
    std::uint64_t crowded = 0;      ///< of more than two
    std::uint64_t unbalanced = 0;   ///< along which faces run more often one way than the other
};

/// \same on any number of threads
[[nodiscard]] edge_tally tally_edges(const working_mesh& mesh);

/// The faces at edges along which faces run more often one way than the other.
///
/// \same on any number of threads
[[nodiscard]] std::vector<std::uint32_t> faces_at_unbalanced_edges(const working_mesh& mesh);

/// [F] the lowest face of each face's part. Faces with a common edge are of one part.
[[nodiscard]] std::vector<std::uint32_t> parts_by_edges(const working_mesh& mesh);

/// [F] the lowest face of each face's shell. Patches are of one shell that meet at an edge where
/// each of them runs more often one way than the other: so what only touches along an edge, as two
/// cubes may, are two shells, and each can be turned without the other.
[[nodiscard]] std::vector<std::uint32_t> shells(const working_mesh& mesh);

/// [F] the lowest face of each face's patch. Two faces that have an edge to themselves are of one
/// patch.
[[nodiscard]] std::vector<std::uint32_t> patches(const working_mesh& mesh);

}  // namespace treeform::detail::repair
