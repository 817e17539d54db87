#pragma once
/// \file
/// What bounds the surface of a prepared mesh closely: its triangles in leaf order, and cylinders
/// around what the nodes of its tree hold.

#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/nearness/bounding_cylinders.hpp>
#include <libmesh/nearness/triangle_blocks.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/buffer.hpp>

namespace treeform::detail::nearness {

/// Some 80 bytes a face; about half as long to make as a tree.
struct face_blocks {
    buffer<eight_triangles> triangles;
    bounding_cylinders cylinders;
};

/// Of the tree `build_face_tree(mesh)`; the mesh keeps them.
[[nodiscard]] const face_blocks& face_blocks_of(const prepared_mesh& mesh);

}  // namespace treeform::detail::nearness
