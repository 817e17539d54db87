#pragma once
/// \file
/// Repair by deleting faces and filling the holes.

#include <treeform/mesh/repair.hpp>

namespace treeform::detail::repair {

/// `repair` in the mode `remove`.
[[nodiscard]] repaired_mesh remove_faces(mesh_view mesh, const repair_options& options);

}  // namespace treeform::detail::repair
