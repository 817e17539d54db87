#pragma once
/// \file
/// What the edges of operands tell before anything is cut: which faces hang together, and where
/// surfaces may end.

#include <libmesh/arrange/numbered_sets.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// An edge along which faces of an operand run more often one way than the other.
struct unbalanced_edge {
    std::uint32_t operand = 0;
    std::array<std::uint32_t, 2> ends{};  ///< ascending
    std::uint32_t face = 0;               ///< the operand's lowest face at the edge
    std::int64_t net = 0;  ///< faces that run from the lower end to the higher, less the others
};

struct operand_edges {
    /// [F] faces of one operand that are linked by edges; in the order of their lowest faces.
    arrange::numbered_sets piece;
    /// [P] whether two faces meet at each edge of the piece, and run opposite ways.
    std::vector<std::uint8_t> is_manifold;
    std::vector<unbalanced_edge> unbalanced;  ///< in the order of their ends, then operands
};

/// Faces with a corner twice have no edges, and are pieces of their own.
///
/// \pre  no two points of `joined` are equal
/// \cost O(V + F log d) for at most d faces at a point; 12 bytes a face and 20 a point on the way
/// \same on any number of threads
[[nodiscard]] operand_edges find_operand_edges(mesh_view joined,
                                               std::span<const std::uint32_t> operand_of_face);

}  // namespace treeform::detail::boolean
