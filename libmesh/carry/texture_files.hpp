#pragma once
/// \file
/// Which texture file a face has.

#include <treeform/mesh/mesh_file.hpp>

namespace treeform::detail::carry {

/// The column "texnumber" of faces, numbers in `texture_files`; null when there is none.
const column* texture_numbers(const mesh_file& file);

}  // namespace treeform::detail::carry
