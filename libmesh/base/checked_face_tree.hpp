#pragma once
/// \file
/// The tree over checked faces.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/tree.hpp>

namespace treeform::detail::base {

/// As `build_face_tree`. \pre every corner is a point
[[nodiscard]] tree<3> checked_face_tree(mesh_view mesh);

}  // namespace treeform::detail::base
