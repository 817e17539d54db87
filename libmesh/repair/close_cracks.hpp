#pragma once
/// \file
/// Cracks and T-junctions closed.

#include <libmesh/repair/working_mesh.hpp>

#include <cstdint>

namespace treeform::detail::repair {

struct closed_cracks {
    std::uint64_t closed_edges = 0;  ///< pairs of border edges that became one
    std::uint64_t split_edges = 0;   ///< border edges split at vertices that lie on them
    std::uint64_t open_edges = 0;    ///< border edges left
    double widest = 0.0;             ///< distance of two points that became one, or of a point and
                                     ///< the edge split at it
};

/// Closes cracks that are nowhere wider than `gap`.
///
/// Two border edges are zipped when each is the nearest to the other, their ends are within the gap
/// of each other and within a quarter of either edge, and no face would get two corners in one
/// point. They may run either way: faces are made to agree later. Nearest pairs come first; of two
/// points the lower number stays. Then a border edge is split at border vertices within the gap of
/// its inside (and nearer than a quarter of the face's height over it) where that makes it meet
/// another border edge.
///
/// \cost O((V + F) log F) for faces; the search looks at border edges alone
/// \same on any number of threads
closed_cracks close_cracks(working_mesh& mesh, double gap);

}  // namespace treeform::detail::repair
