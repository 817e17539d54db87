#pragma once
/// \file
/// The exact nesting of the loops of a plane.

#include <libmesh/cut/layer_loops.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::cut {

/// The nesting of a loop, as in `section_loop`, with loop numbers of the layer.
struct nesting {
    std::uint32_t parent;
    std::uint32_t depth;
};

/// \param centers, radius  where each point of the loops is, and how far off at most
/// \return for each loop; open ones are in none, and none is in them
/// \cost   O(S log L) for L loops of S sides, and for each loop the sides beyond one of its points
[[nodiscard]] std::vector<nesting> nested_loops(mesh_view mesh, const plane_levels& levels,
                                                std::uint32_t k, const layer_loops& layer,
                                                std::span<const point3> centers, double radius);

}  // namespace treeform::detail::cut
