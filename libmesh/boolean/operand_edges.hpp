#pragma once
/// \file
/// Edges of operands before cutting: the pieces that they link, and the edges at which surfaces may
/// be open.

#include <libmesh/arrange/numbered_sets.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// An edge at which the signed face count of an operand is not zero.
struct unbalanced_edge {
    std::uint32_t operand = 0;
    std::array<std::uint32_t, 2> ends{};  ///< ascending
    std::uint32_t face = 0;               ///< the operand's lowest face at the edge
    /// signed face count: faces that run from the lower end to the higher, minus the others
    std::int64_t net = 0;
};

struct operand_edges {
    /// [F] piece of each face: faces of one operand linked by edges; in the order of their lowest
    /// faces.
    arrange::numbered_sets piece;
    /// [P] whether each edge of the piece has two consistently oriented faces.
    std::vector<std::uint8_t> is_manifold;
    std::vector<unbalanced_edge> unbalanced;  ///< in the order of their ends, then operands
};

/// Faces that repeat a corner have no edges, and are pieces of their own.
///
/// \pre  no two points of `joined` are equal
/// \cost O(V + F log d) for at most d faces at a point; temporarily 12 bytes a face and 20 a point
/// \same on any number of threads
[[nodiscard]] operand_edges find_operand_edges(mesh_view joined,
                                               std::span<const std::uint32_t> operand_of_face);

}  // namespace treeform::detail::boolean
