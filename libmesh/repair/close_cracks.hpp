#pragma once
/// \file
/// Closes cracks and T-junctions.

#include <libmesh/repair/working_mesh.hpp>

#include <cstdint>

namespace treeform::detail::repair {

struct closed_cracks {
    std::uint64_t closed_edges = 0;  ///< pairs of border edges that became one
    std::uint64_t split_edges = 0;   ///< border edges split at vertices that lie on them
    std::uint64_t open_edges = 0;    ///< border edges left
    /// largest distance of two joined points, or of a point from the edge split at it
    double widest = 0.0;
};

/// Closes cracks of at most the width `gap`.
///
/// Two border edges are joined if each is the nearest to the other, their ends are within the gap
/// of each other and within a quarter of either edge's length, and no face would repeat a corner.
/// They may have any direction, since faces are oriented later. Nearest pairs are joined first; of
/// two points, the lower number is kept. Then a border edge is split at border vertices within the
/// gap of its interior (and nearer than a quarter of the face's height over it) if that lets it
/// match another border edge.
///
/// \cost O((V + F) log F) for faces; only border edges are searched
/// \same on any number of threads
closed_cracks close_cracks(working_mesh& mesh, double gap);

}  // namespace treeform::detail::repair
