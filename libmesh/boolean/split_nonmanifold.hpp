#pragma once
/// \file
/// Splits edges and vertices at which parts of a solid touch.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::boolean {

struct manifold_surface {
    mesh surface{};  ///< the former vertices, then the added ones
    /// the former vertex with the coordinates of each added one
    std::vector<std::uint32_t> vertex_of_added{};
    std::uint64_t shared_edges = 0;  ///< number of remaining edges with more than two faces
};

/// The surface of a solid as a manifold: where parts of it touch in an edge or at a vertex, each
/// part gets its own vertices there, with equal coordinates. The point set does not change.
///
/// At an edge of four or more faces, the two faces of each wedge of the solid stay connected; if
/// that gives two edges between the same points, as in a ring that touches itself, the two faces of
/// each wedge of the outside do. An edge that neither separates is kept and counted: it would need
/// a point between its ends. Edges at which faces do not alternate between inside and outside are
/// also kept.
///
/// \pre    two faces have a common corner, a common edge or nothing in common, none is degenerate,
///         the signed face count of every edge is zero, and every corner is a vertex
///         (`boolean_result`)
/// \cost   O(V + F log d) for at most d faces at a point; predicates only at edges of more than two
///         faces
/// \same   on any number of threads
[[nodiscard]] manifold_surface split_nonmanifold(mesh&& solid);

/// The same for a result, with its sources; counts the added vertices.
void split_nonmanifold(boolean_result& result);

}  // namespace treeform::detail::boolean
