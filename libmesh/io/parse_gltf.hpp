#pragma once
/// \file
/// Parses the JSON of a glTF.

#include <libmesh/io/model_gltf.hpp>
#include <libmesh/io/source.hpp>

#include <string_view>

namespace treeform::detail::io {

/// Parses the relevant JSON of glTF 2.0. Of materials, only the color and the texture coordinates
/// are used; cameras, lights, images, animations and most `extras` are ignored.
///
/// \throws io_error naming the byte, or the entry, as "accessors[3].count"; for values of a wrong
///         type, indices out of range, versions other than 1 and 2, and required extensions, except
///         for supported ones and those that only change how a surface looks
[[nodiscard]] model_gltf parse_gltf(const source& in, std::string_view json);

}  // namespace treeform::detail::io
