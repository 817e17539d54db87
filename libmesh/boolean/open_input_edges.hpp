#pragma once
/// \file
/// Where surfaces of operands end, found before anything is cut.

#include <libmesh/boolean/operand_edges.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// A stretch of an edge along which an operand's faces run more often one way than the other.
struct open_stretch {
    std::uint32_t face = 0;               ///< of the operand, at the edge
    std::array<std::uint32_t, 2> ends{};  ///< points, ascending
};

struct open_input_edges {
    std::vector<open_stretch> stretches;  ///< the first by their ends, at most 100
    std::uint64_t count = 0;              ///< of stretches; 0 where all operands are closed
    /// Of the edges as they are, where none of them overlaps another one: those of an odd number of
    /// faces, and those of an even number, of which more run one way than the other.
    std::uint64_t boundary_edges = 0;
    std::uint64_t misoriented_edges = 0;
};

/// Exact: faces cut along each other fit together where along every line, the unbalanced edges of
/// each operand cancel out. An edge of one face may do so with two of the faces beyond it.
///
/// \pre  no two of `points` are equal; they are finite
/// \cost O(E log E) time for E edges of which few overlap
/// \same on any number of threads
[[nodiscard]] open_input_edges find_open_input_edges(points_view points,
                                                     std::span<const unbalanced_edge> unbalanced);

}  // namespace treeform::detail::boolean
