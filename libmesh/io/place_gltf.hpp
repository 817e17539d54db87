#pragma once
/// \file
/// Puts the meshes of a glTF where its scene has them.

#include <libmesh/io/bytes_gltf.hpp>
#include <libmesh/io/model_gltf.hpp>
#include <libmesh/io/source.hpp>
#include <treeform/mesh/mesh_file.hpp>

namespace treeform::detail::io {

/// One mesh of all that the nodes of the scene show, each as a part with a name of its own: that of
/// the node, else of the mesh. Points that a transform has moved are doubles; others are as they
/// are stored. Where a transform mirrors, faces are turned over.
///
/// \throws io_error for nodes that are no tree or too deep, and for what does not fit
[[nodiscard]] mesh_file place_gltf(const source& in, const model_gltf& model,
                                   buffers_gltf& buffers);

}  // namespace treeform::detail::io
