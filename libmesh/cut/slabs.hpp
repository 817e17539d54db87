#pragma once
/// \file
/// The faces of a mesh cut by parallel planes, and the caps that close what is between them,
/// exactly.

#include <libmesh/cut/plane_levels.hpp>
#include <libmesh/round/round_surface.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::cut {

/// What is between two planes, before rounding.
struct slab {
    exact_surface surface;
    std::vector<std::uint32_t>
        face_of;  ///< [F] face of the mesh, or its face count + the plane of a cap
    std::vector<std::uint32_t> point_of;  ///< [given] point of the mesh
};

/// [K + 1] Slabs below, between and above the planes of `levels`.
///
/// \pre    any two faces have a corner, an edge or nothing in common, none is degenerate; with
///         `caps`, they bound a solid
/// \cost   O(F + n log n) for n faces that are cut; caps as `triangles_of`
/// \same   on any number of threads
[[nodiscard]] std::vector<slab> slabs_of(mesh_view mesh, const plane_levels& levels, bool caps);

}  // namespace treeform::detail::cut
