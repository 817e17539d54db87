#pragma once
/// \file
/// Repair by deleting faces and filling the holes.

#include <libmesh/repair/repair.hpp>

namespace tf::detail {

/// `repair` in the mode `remove`.
[[nodiscard]] repaired_mesh remove_faces(mesh_view mesh, const repair_options& options);

}  // namespace tf::detail
