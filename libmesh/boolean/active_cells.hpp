#pragma once
/// \file
/// Which parts of an arrangement's faces bound the result, where faces that cannot are missing.

#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/boolean/active_space.hpp>
#include <libmesh/boolean/partial_expression.hpp>
#include <libmesh/boolean/surface_components.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

struct active_cells {
    arrangement_cells cells;  ///< with `cell_of_side` alone; 0 on both sides of hidden faces
    std::vector<std::uint8_t> inside;  ///< [C]
};

/// The result's surface is in active space, and there all faces are present. So faces with a corner
/// outside of it are hidden. Of the others, those that all of active space is known to hold have the
/// same winding numbers on all of a side, and edges between them tell how these change; what that
/// does not reach, one line tells, which is followed through all components. Other faces may have
/// been left uncut somewhere out of active space: each is told by a line of its own.
///
/// \param mesh the active faces, with the points of all; `cut` is their arrangement, in which pairs
///             may be missing that meet outside of active space
/// \param operand_of_face [F] of `mesh`
/// \same  on any number of threads
[[nodiscard]] active_cells find_active_cells(mesh_view mesh, const mesh_arrangement& cut,
                                             std::span<const std::uint32_t> operand_of_face,
                                             const surface_components& components,
                                             const active_space& space,
                                             const partial_expression& at_nowhere);

}  // namespace treeform::detail::boolean
