#pragma once
/// \file
/// The tree over the faces of a mesh, for queries.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/tree.hpp>

namespace treeform {

/// The tree over the boxes of the faces of `mesh`; `ids()` are face numbers.
///
/// It is valid as long as no point moves; if the mesh moves as a whole, pass the transform to
/// queries instead. Points that no face uses are ignored.
///
/// \throws std::invalid_argument naming the lowest face with a corner out of range, or that is
///         not finite
/// \cost   O(F log F) time, about 30 bytes a face
/// \same   on any number of threads `function` is the name of the called function in the message:
/// "distance: b".
[[nodiscard]] TREEFORM_API tree<3> build_face_tree(mesh_view mesh,
                                                   const char* function = "build_face_tree");

/// The same for a prepared mesh, which keeps the tree.
[[nodiscard]] TREEFORM_API const tree<3>& build_face_tree(const prepared_mesh& mesh,
                                                          const char* function = "build_face_tree");

}  // namespace treeform
