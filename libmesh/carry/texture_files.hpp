#pragma once
/// \file
/// The texture file of a face.

#include <treeform/mesh/mesh_file.hpp>

namespace treeform::detail::carry {

/// The column "texnumber" of faces, with indices into `texture_files`; null if there is none.
const column* texture_numbers(const mesh_file& file);

}  // namespace treeform::detail::carry
