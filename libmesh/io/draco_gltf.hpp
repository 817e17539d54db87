#pragma once
/// \file
/// Primitives of a glTF that KHR_draco_mesh_compression packs.

#include <libmesh/io/bytes_gltf.hpp>
#include <libmesh/io/model_gltf.hpp>

#include <cstddef>

namespace treeform::detail::io {

/// Whether treeform was built with draco.
[[nodiscard]] bool reads_draco();

/// Unpacks the attributes that are read and the indices, and gives them to the buffers as the
/// values of their accessors.
///
/// \pre    `primitive.draco`
/// \throws io_error for bytes that are damaged or announce more than they can hold, for another
///         number of values than that of the accessors, and without draco
void unpack_draco(buffers_gltf& buffers, const model_gltf& model, std::size_t mesh,
                  const primitive_gltf& primitive);

}  // namespace treeform::detail::io
