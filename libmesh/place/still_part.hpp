#pragma once
/// \file
/// Meshes that stay where they are while another one is moved among them.

#include <libmesh/mesh.hpp>
#include <libtree/tree.hpp>

namespace tf {

/// Somebody else's mesh and its tree, which outlive this.
struct still_part {
    mesh_view mesh{};
    const tree<3>* faces = nullptr;  ///< `face_tree(mesh)`
};

}  // namespace tf
