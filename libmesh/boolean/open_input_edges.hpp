#pragma once
/// \file
/// Finds open edges of operands before cutting.

#include <libmesh/boolean/operand_edges.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// A part of an edge at which the signed face count of an operand is not zero.
struct open_stretch {
    std::uint32_t face = 0;               ///< a face of the operand at the edge
    std::array<std::uint32_t, 2> ends{};  ///< points, ascending
};

struct open_input_edges {
    std::vector<open_stretch> stretches;  ///< the first by their ends, at most 100
    std::uint64_t count = 0;              ///< number of stretches; 0 if all operands are closed
    /// If no edges overlap: the number of open edges with an odd number of faces, and with an even
    /// number of inconsistently oriented faces.
    std::uint64_t boundary_edges = 0;
    std::uint64_t misoriented_edges = 0;
};

/// Exact. Operands are closed after cutting if, along every line, the unbalanced edges of each
/// operand cancel out; an edge of one face may cancel with the edges of two other faces.
///
/// \pre  no two of `points` are equal; they are finite
/// \cost O(E log E) time for E edges of which few overlap
/// \same on any number of threads
[[nodiscard]] open_input_edges find_open_input_edges(points_view points,
                                                     std::span<const unbalanced_edge> unbalanced);

}  // namespace treeform::detail::boolean
