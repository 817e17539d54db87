#pragma once
/// \file
/// Cuts the faces of a mesh by parallel planes, exactly, with caps that close the slabs.

#include <libmesh/cut/plane_levels.hpp>
#include <libmesh/round/round_surface.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::cut {

/// The part of a mesh between two planes, before rounding.
struct slab {
    exact_surface surface;
    std::vector<std::uint32_t>
        face_of;  ///< [F] source face; for a cap, number of faces of the mesh + number of its plane
    std::vector<std::uint32_t> point_of;  ///< [given] source points in the mesh
};

/// [K + 1] The slabs below, between and above the planes of `levels`.
///
/// \pre    any two faces have a corner, an edge or nothing in common, none is degenerate; with
///         `caps`, they bound a solid
/// \cost   O(F + n log n) for n cut faces; caps as `triangles_of`
/// \same   on any number of threads
[[nodiscard]] std::vector<slab> slabs_of(mesh_view mesh, const plane_levels& levels, bool caps);

}  // namespace treeform::detail::cut
