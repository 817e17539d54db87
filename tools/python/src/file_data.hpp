#pragma once
/// \file
/// What a mesh has besides points and faces.

#include <treeform/mesh/mesh_file.hpp>

namespace binding {

/// All that a file has besides points and faces: a `mesh_file` without its mesh.
struct file_data {
    treeform::mesh_file file{};
};

}  // namespace binding
