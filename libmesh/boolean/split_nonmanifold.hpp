#pragma once
/// \file
/// Solids that touch themselves, with vertices and edges of their own for each part.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::boolean {

struct manifold_surface {
    mesh surface{};                                ///< vertices of before, then those added
    std::vector<std::uint32_t> vertex_of_added{};  ///< the vertex of before with these coordinates
    std::uint64_t shared_edges = 0;                ///< edges of more than two faces that are left
};

/// The surface of a solid as a manifold: where parts of it touch in an edge or at a vertex, each
/// gets vertices of its own there, with equal coordinates. As a set of points nothing changes.
///
/// Around an edge of four faces or more, the two at each wedge of the solid stay together; where
/// that leaves an edge twice between the same points, as in a ring that touches itself, the two at
/// each wedge of space do. An edge that neither tells apart stays, and is counted: that takes a
/// point between its ends. Edges along which faces do not alternate between inside and outside stay
/// as they are, too.
///
/// \pre    two faces have a common corner, a common edge or nothing in common, none is degenerate,
///         along each edge they run as often one way as the other, and every corner
///         is a vertex (`boolean_result`)
/// \cost   O(V + F log d) for at most d faces at a point; predicates only at edges of more than two
///         faces
/// \same   on any number of threads
[[nodiscard]] manifold_surface split_nonmanifold(mesh&& solid);

/// The same of a result, with its sources; counts vertices added.
void split_nonmanifold(boolean_result& result);

}  // namespace treeform::detail::boolean
