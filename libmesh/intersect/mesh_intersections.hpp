#pragma once
/// \file
/// Intersections of two meshes whose trees are known.

#include <libmesh/base/effort.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/tree.hpp>

namespace treeform::detail::intersect {

/// As `treeform::mesh_intersections`, but only checks the faces that it tests. With `effort`, each
/// pair whose boxes overlap is spent; if these exceed the allowance, the status is `cancelled`, and
/// no pairs are listed or counted.
///
/// \pre    `tree_a` and `tree_b` are `build_face_tree(a)` and `build_face_tree(b)`
/// \throws std::invalid_argument unless each tree has one primitive for each face
[[nodiscard]] TREEFORM_API face_pair_result
mesh_intersections(mesh_view a, const tree<3>& tree_a, mesh_view b, const tree<3>& tree_b,
                   const face_pair_options& options = {}, base::effort* effort = nullptr);

/// As `treeform::intersects`. Which invalid face is reported, if any, may depend on the threads.
///
/// \pre the trees contain all faces of the meshes that may meet
[[nodiscard]] TREEFORM_API bool intersects(mesh_view a, const tree<3>& tree_a, mesh_view b,
                                           const tree<3>& tree_b,
                                           const mesh_pair_options& positions = {});

}  // namespace treeform::detail::intersect
