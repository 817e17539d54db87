#pragma once
/// \file
/// The tree over the faces of a mesh.

#include <libmesh/mesh.hpp>
#include <libtree/export.hpp>
#include <libtree/tree.hpp>

namespace tf {

/// The tree over the boxes of the faces, for any number of queries.
///
/// \throws std::invalid_argument naming the lowest face with a corner that is no point, or that is
///         not finite; points that no face uses may be anything
/// \cost   that of `build`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API tree<3> face_tree(mesh_view mesh);

}  // namespace tf
