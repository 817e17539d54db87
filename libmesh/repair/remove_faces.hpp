#pragma once
/// \file
/// Self-intersections resolved by deleting faces and filling the holes.

#include <treeform/mesh/repair.hpp>

namespace treeform::detail::repair {

/// `resolve_self_intersections` in the mode `remove`.
[[nodiscard]] repair_result remove_faces(mesh_view mesh, const resolve_options& options);

}  // namespace treeform::detail::repair
