#pragma once
/// \file
/// The faces of an arrangement that bound a choice of its cells.

#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::round {

struct solid_faces {
    std::vector<face> faces;             ///< in the order of the arrangement; inside is behind
    std::vector<std::uint32_t> face_of;  ///< face of the arrangement that each one is
};

/// The faces with exactly one side in cells that are inside. Along each edge they run as often one
/// way as the other, since all of space is inside or not.
///
/// \pre `inside` has a value for each cell, and `cells.open` is empty
[[nodiscard]] solid_faces faces_around(const mesh_arrangement& cut, const arrangement_cells& cells,
                                       const std::vector<std::uint8_t>& inside);

}  // namespace treeform::detail::round
