#pragma once
/// \file
/// The JSON of a glTF.

#include <libmesh/io/model_gltf.hpp>
#include <libmesh/io/source.hpp>

#include <string_view>

namespace treeform::detail::io {

/// Reads what matters of the JSON of glTF 2.0. Materials count only for the texture coordinates
/// that they use; cameras, lights, images, animations and what `extras` hold are not looked at.
///
/// \throws io_error naming the byte, or the entry, as "accessors[3].count"; for values of a wrong
///         type, numbers of things that are not there, other versions than 1 and 2; and for
///         extensions that the file requires, except for those that are read and those that only
///         change how it looks
[[nodiscard]] model_gltf parse_gltf(const source& in, std::string_view json);

}  // namespace treeform::detail::io
