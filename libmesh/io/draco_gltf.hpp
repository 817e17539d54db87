#pragma once
/// \file
/// Unpacks primitives of a glTF with KHR_draco_mesh_compression.

#include <libmesh/io/bytes_gltf.hpp>
#include <libmesh/io/model_gltf.hpp>

#include <cstddef>

namespace treeform::detail::io {

/// Whether treeform was built with draco.
[[nodiscard]] bool reads_draco();

/// Unpacks the indices and the supported attributes, and sets them as the values of their
/// accessors.
///
/// \pre    `primitive.draco`
/// \throws io_error for damaged data, for data that claims more values than it can hold, if the
///         number of values differs from that of the accessors, and without draco
void unpack_draco(buffers_gltf& buffers, const model_gltf& model, std::size_t mesh,
                  const primitive_gltf& primitive);

}  // namespace treeform::detail::io
