#pragma once
/// \file
/// Points of faces that meet are put on a uniform grid.

#include <libmesh/round/snap_nearby.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>

namespace treeform::detail::round {

/// The multiple of `step` nearest to each coordinate; of two, the even one.
/// \pre `step` is a power of two, and coordinates are less than 2^53 times as large
[[nodiscard]] point3 on_grid(const point3& p, double step);

struct grid_joint {
    double step = 0.0;  ///< of the grid
    bool solid = true;  ///< the faces bound a solid: what covers each other back to back goes
    /// The faces are those of several operands, which may lie on each other: then none goes that
    /// has three corners.
    bool of_operands = false;
};

/// Puts the corners of offending faces on the grid, and all other points that would come to the
/// same places. Points at one place become one, the lowest; of the faces, those that repeat a
/// corner go, and of several with the same corners one stays, or, of a solid, what does not cancel.
///
/// On a uniform grid features vanish alike everywhere, while the numbers of one precision get
/// denser toward the origin: there the rounding of cuts makes smaller and smaller ones.
///
/// \param  offending  [F]
/// \cost   O(V + F) time, and sorting for the points that are moved
/// \same   on any number of threads
/// \source Lazard and Valque, Removing self-intersections in 3D meshes while preserving
///         floating-point coordinates, SGP 2025: rounds of snapping and subdividing
[[nodiscard]] joined_near snap_to_grid(mesh_view mesh, std::span<const std::uint8_t> offending,
                                       const grid_joint& how);

}  // namespace treeform::detail::round
