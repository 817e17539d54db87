#pragma once
/// \file
/// Meshes that stay where they are while another one is moved among them.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/tree.hpp>

namespace treeform {

/// Somebody else's mesh and its tree, which outlive this.
struct still_part {
    mesh_view mesh{};
    const tree<3>* faces = nullptr;  ///< `face_tree(mesh)`
};

}  // namespace treeform
