#pragma once
/// \file
/// The tree over faces that have been checked.

#include <libmesh/mesh.hpp>
#include <libtree/tree.hpp>

namespace tf::detail {

/// As `face_tree`. \pre every corner is a point
[[nodiscard]] tree<3> checked_face_tree(mesh_view mesh);

}  // namespace tf::detail
