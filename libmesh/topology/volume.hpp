#pragma once
/// \file
/// Signed volumes of faces, in extended precision.

#include <libmesh/base/double_double.hpp>
#include <treeform/mesh/mesh.hpp>

namespace treeform::detail::topology {

/// Six times the signed volume between the origin and the faces, in twice the precision of double,
/// since contributions of a closed surface far from the origin cancel. Single-threaded.
///
/// \pre corners are valid point numbers
/// \same on any machine
[[nodiscard]] base::double_double six_volumes(mesh_view surface);

}  // namespace treeform::detail::topology
