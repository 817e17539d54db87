#pragma once
/// \file
/// The relation of two meshes at the places where they are, or may come to be.

#include <libmesh/place/shape.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/tree/parallel.hpp>

namespace treeform::detail::place {

/// As `relation`, which has checked the operands.
[[nodiscard]] mesh_relation_result relation_of(const shape& a, const shape& b,
                                               const progress_callback& progress = {});

}  // namespace treeform::detail::place
