#pragma once
/// \file
/// Intersections of two meshes whose trees are known.

#include <libmesh/base/effort.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/tree.hpp>

namespace treeform::detail::intersect {

/// As `treeform::mesh_intersections`; only faces that are looked at are checked. With an effort,
/// it spends the pairs whose boxes overlap; where these are too many, it is `cancelled`, and lists
/// and counts nothing.
///
/// \pre    `tree_a` and `tree_b` are `build_face_tree(a)` and `build_face_tree(b)`
/// \throws std::invalid_argument when a tree has not one primitive a face
[[nodiscard]] TREEFORM_API intersection_result
mesh_intersections(mesh_view a, const tree<3>& tree_a, mesh_view b, const tree<3>& tree_b,
                   const intersection_options& options = {}, base::effort* effort = nullptr);

/// As `treeform::intersects`. Which bad face is met, if any, may depend on the threads.
///
/// \pre the trees are of faces of the meshes: of all that may meet
[[nodiscard]] TREEFORM_API bool intersects(mesh_view a, const tree<3>& tree_a, mesh_view b,
                                           const tree<3>& tree_b,
                                           const mesh_positions& positions = {});

}  // namespace treeform::detail::intersect
