#pragma once
/// \file
/// Texture files of several files, and the numbers by which their faces name them.

#include <treeform/mesh/mesh_file.hpp>

#include <span>
#include <string>
#include <vector>

namespace treeform::detail::io {

/// Gives all `files` one list of texture files, that of the first with the names that further ones
/// add, and their faces int32 numbers in it. `names` stand for the files in what is warned of.
///
/// Faces of a file without numbers have that of its first name. Those that named none have -1, as
/// all of a file without names; numbers other than -1 that name none are warned of. Faces are given
/// no numbers where one name is all there is and no file has numbers, or texture coordinates
/// without a name. A single file stays as it is, and so do files without names.
[[nodiscard]] std::vector<io_warning> unite_textures(std::span<mesh_file> files,
                                                     std::span<const std::string> names);

}  // namespace treeform::detail::io
