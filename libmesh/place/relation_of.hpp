#pragma once
/// \file
/// The relation of two meshes at the places where they are, or may come to be.

#include <libmesh/base/effort.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/tree/parallel.hpp>

namespace treeform::detail::place {

/// As `relation`, which has checked the operands; `cancelled`, too, where the effort does not
/// suffice for one of its searches for pairs of faces.
[[nodiscard]] mesh_measure relation_of(const shape& a, const shape& b,
                                       const progress_callback& progress = {},
                                       base::effort* effort = nullptr);

}  // namespace treeform::detail::place
