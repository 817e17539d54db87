#pragma once
/// \file
/// Detects tetrahedra stored as faces with four corners, as viewers write volume meshes.

#include <libmesh/repair/working_mesh.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>

namespace treeform::detail::repair {

/// The number of tetrahedra of which `mesh` consists; 0 if it is anything else.
///
/// Each tetrahedron a, b, c, d is stored as two consecutive faces (a, b, c) and (a, c, d): a face
/// of four corners, cut into triangles. All of these conditions must hold:
/// - every face is in such a pair, and the volumes of the tetrahedra have the same sign, not 0
///   (`orient3d`);
/// - no face belongs to three tetrahedra, or to two on the same side of it;
/// - each tetrahedron shares a face, three corners, with another one. Quads of a surface share only
///   two corners with their neighbors.
///
/// \pre  no two points used by faces are equal
/// \cost O(F log F); O(1) if the first faces are not such a pair
[[nodiscard]] std::uint64_t count_tetrahedra(mesh_view mesh);

/// If `mesh` consists of tetrahedra, replaces them by their unshared faces, outward, each with the
/// source of a face of its tetrahedron, and returns the number of tetrahedra. Otherwise changes
/// nothing and returns 0.
std::uint64_t keep_boundary_of_tetrahedra(working_mesh& mesh);

}  // namespace treeform::detail::repair
