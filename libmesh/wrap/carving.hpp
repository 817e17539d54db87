#pragma once
/// \file
/// Space around a mesh, cut away as far as a ball gets.

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
    double size = 0.0;    ///< least radius of a ball that passes
    double offset = 0.0;  ///< of corners from the mesh
    treeform::precision precision = treeform::precision::float64;  ///< of corners
};

/// What is left of a box.
struct carved_space {
    tetrahedralization cells;
    std::vector<std::uint8_t> is_outside;  ///< by tetrahedron
};

/// Tetrahedra in a box around `mesh`, outside as far as they can be reached from the box through
/// faces that a ball passes. None that is outside meets the mesh: exact. None where `stop` says so,
/// which receives how many tetrahedra were looked at, and how many faces wait.
///
/// \param around  further from the mesh than the size
/// \cost  see `wrap`
/// \source Portaneri et al., Alpha Wrapping with an Offset, section 3
[[nodiscard]] std::optional<carved_space> carve(
    const offset_surface& mesh, const box3& around, const carving_options& options,
    function_ref<bool(std::size_t done, std::size_t waiting)> stop);

}  // namespace treeform::detail::wrap
