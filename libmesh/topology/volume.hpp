#pragma once
/// \file
/// Volumes behind faces, precisely.

#include <libmesh/base/double_double.hpp>
#include <treeform/mesh/mesh.hpp>

namespace treeform::detail::topology {

/// Six times the volume between the origin and faces, in twice the precision of double, as parts of
/// a closed surface far from the origin cancel. On one thread.
///
/// \pre corners are points
/// \same on any machine
[[nodiscard]] base::double_double six_volumes(mesh_view surface);

}  // namespace treeform::detail::topology
