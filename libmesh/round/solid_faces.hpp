#pragma once
/// \file
/// The faces of an arrangement that bound the chosen cells.

#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::round {

struct solid_faces {
    std::vector<face> faces;  ///< in the order of the arrangement, with the inside behind
    std::vector<std::uint32_t> face_of;  ///< [F] the face of the arrangement
};

/// The faces with exactly one side in cells that are inside. They are closed: the signed face count
/// of every edge is zero.
///
/// \pre `inside` has a value for each cell, and `cells.open` is empty
[[nodiscard]] solid_faces faces_around(const mesh_arrangement& cut, const arrangement_cells& cells,
                                       const std::vector<std::uint8_t>& inside);

}  // namespace treeform::detail::round
