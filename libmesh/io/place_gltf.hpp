#pragma once
/// \file
/// Converts the scene of a glTF to one mesh.

#include <libmesh/io/bytes_gltf.hpp>
#include <libmesh/io/model_gltf.hpp>
#include <libmesh/io/source.hpp>
#include <treeform/mesh/mesh_file.hpp>

namespace treeform::detail::io {

/// The meshes of all nodes of the scene, transformed, each as a part with a unique name: that of
/// the node, else of the mesh. Transformed points are doubles; others are as stored. Faces of
/// mirrored parts are flipped.
///
/// \throws io_error if nodes do not form a tree or are nested too deeply, and if there are too many
///         elements
[[nodiscard]] mesh_file place_gltf(const source& in, const model_gltf& model,
                                   buffers_gltf& buffers);

}  // namespace treeform::detail::io
