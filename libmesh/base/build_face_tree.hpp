#pragma once
/// \file
/// The tree over the faces of a mesh, which queries of meshes take.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/tree.hpp>

namespace treeform {

/// The tree over the boxes of the faces of `mesh`; `ids()` are face numbers.
///
/// It stays that of the mesh while no point moves; for a mesh that moves as a whole, queries take a
/// transform. Points that no face uses do not matter.
///
/// \throws std::invalid_argument naming the lowest face with a corner out of range, or that is
///         not finite
/// \cost   O(F log F) time, some 30 bytes a face
/// \same   on any number of threads
/// `function` is what was called, for the message: "distance: b".
[[nodiscard]] TREEFORM_API tree<3> build_face_tree(mesh_view mesh,
                                                   const char* function = "build_face_tree");

/// The same of a prepared mesh, which keeps it.
[[nodiscard]] TREEFORM_API const tree<3>& build_face_tree(const prepared_mesh& mesh,
                                                          const char* function = "build_face_tree");

}  // namespace treeform
