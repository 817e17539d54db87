#pragma once
/// \file
/// The relation of two placed meshes.

#include <libmesh/base/effort.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/tree/parallel.hpp>

namespace treeform::detail::place {

/// `relation`, without the checks of the operands. Also `cancelled` when the effort is exhausted in
/// one of its searches for pairs of faces.
[[nodiscard]] mesh_measure relation_of(const shape& a, const shape& b,
                                       const progress_callback& progress = {},
                                       base::effort* effort = nullptr);

}  // namespace treeform::detail::place
