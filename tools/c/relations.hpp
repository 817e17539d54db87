#pragma once
/// \file
/// How two meshes lie, in C.

#include <tools/c/glue.hpp>
#include <treeform/mesh/measure.hpp>

namespace glue {

/// Its owner is null.
[[nodiscard]] treeform_relation relation_of(const tf::mesh_measure& from);

}  // namespace glue
