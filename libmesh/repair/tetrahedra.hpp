#pragma once
/// \file
/// Faces with four corners that are tetrahedra: what viewers write of volume meshes.

#include <libmesh/repair/working_mesh.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>

namespace treeform::detail::repair {

/// How many tetrahedra `mesh` is; 0 where it is anything else.
///
/// Each tetrahedron a, b, c, d stands there as the faces (a, b, c) and (a, c, d), one after the
/// other: a face of four corners, cut into triangles. It is one only where no doubt is left:
/// - every face is of such a pair, and the tetrahedra have a volume, all of one sign (`orient3d`);
/// - of their faces, none belongs to three, and none to two that lie on one side of it;
/// - each tetrahedron shares a face, three corners, with another one. Faces of four corners of a
///   surface share two with their neighbors.
///
/// \pre  no two points are equal, as far as faces use them
/// \cost O(F log F); where the first faces are no pair, nothing
[[nodiscard]] std::uint64_t count_tetrahedra(mesh_view mesh);

/// Replaces the tetrahedra that `mesh` is by the faces that they do not share, outward, each with
/// the source of a face of its tetrahedron; returns their number. Leaves alone what is none.
std::uint64_t keep_boundary_of_tetrahedra(working_mesh& mesh);

}  // namespace treeform::detail::repair
