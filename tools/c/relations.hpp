#pragma once
/// \file
/// How two meshes lie, in C.

#include <treeform/mesh/measure.hpp>

#include <tools/c/glue.hpp>

namespace glue {

/// Its owner is null.
[[nodiscard]] treeform_relation relation_of(const tf::mesh_measure& from);

}  // namespace glue
