#pragma once
/// \file
/// Carves the space around a mesh that a ball can reach.

#include <libmesh/wrap/offset_surface.hpp>
#include <libmesh/wrap/tetrahedralization.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/function_ref.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace treeform::detail::wrap {

struct carving_options {
    double size = 0.0;    ///< radius of the ball: it passes faces that admit at least this radius
    double offset = 0.0;  ///< distance of corners from the mesh
    treeform::precision precision = treeform::precision::float64;  ///< precision of corners
};

/// The tetrahedra of a carved box.
struct carved_space {
    tetrahedralization cells;
    std::vector<std::uint8_t> is_outside;  ///< [tetrahedra] 1: outside
};

/// Fills a box around `mesh` with tetrahedra and marks as outside those that can be reached from
/// the sides of the box through faces that the ball passes. No outside tetrahedron meets the mesh;
/// that is exact. Empty when `stop`, which receives the numbers of processed tetrahedra and of
/// waiting faces, returns true.
///
/// \param around  a box that is farther from the mesh than the size
/// \cost  see `wrap`
/// \source Portaneri et al., Alpha Wrapping with an Offset, section 3
[[nodiscard]] std::optional<carved_space> carve(
    const offset_surface& mesh, const box3& around, const carving_options& options,
    function_ref<bool(std::size_t done, std::size_t waiting)> stop);

}  // namespace treeform::detail::wrap
