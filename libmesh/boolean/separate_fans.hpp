#pragma once
/// \file
/// Solids that touch themselves, with points and edges of their own for each part.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/export.hpp>

#include <cstdint>
#include <vector>

namespace treeform {

struct separated_fans {
    mesh surface;                         ///< points of before, then those that were doubled
    std::vector<std::uint32_t> point_of;  ///< [V'] the point of before with these coordinates
    std::uint64_t doubled_points = 0;     ///< points that were added
    std::uint64_t shared_edges = 0;       ///< edges of more than two faces that are left
};

/// The surface of a solid as a manifold: where parts of it touch in an edge or in a point, each
/// gets points of its own there, with equal coordinates. As a set of points nothing changes.
///
/// Around an edge of four faces or more, the two at each wedge of the solid stay together; where
/// that leaves an edge twice between the same points, as in a ring that touches itself, the two at
/// each wedge of space do. An edge that neither tells apart stays, and is counted: that takes a
/// point between its ends. Edges along which faces do not alternate between inside and outside stay
/// as they are, too.
///
/// \pre    two faces have a common corner, a common edge or nothing in common, none is degenerate,
///         and along each edge they run as often one way as the other (`solid_result::certified`)
/// \throws std::invalid_argument naming the lowest face with a corner that is no point
/// \cost   O(V + F log d) for at most d faces at a point; predicates only at edges of more than two
///         faces
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API separated_fans separate_fans(mesh_view solid);

}  // namespace treeform
