#pragma once
/// \file
/// The leaf blocks of a prepared mesh as boxes of their own, and which of them overlap.

#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/answers.hpp>
#include <treeform/tree/tree.hpp>

#include <vector>

namespace treeform::detail::boolean {

/// Block b is the faces at places 8 b to 8 b + 7 of `build_face_tree(mesh)`.
struct leaf_blocks {
    tree<3> index;                               ///< over the boxes of blocks
    std::vector<std::vector<id_pair>> overlaps;  ///< blocks whose boxes overlap, in parts
};

/// Of a mesh with faces, which keeps them.
///
/// \cost once, O(F log F), a tenth of a tree of its faces; some 15 bytes a face
/// \same on any number of threads
[[nodiscard]] const leaf_blocks& leaf_blocks_of(const prepared_mesh& mesh);

}  // namespace treeform::detail::boolean
