#pragma once
/// \file
/// The faces that meet a box.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/export.hpp>

#include <cstdint>
#include <vector>

namespace treeform {

/// Numbers of the faces, ascending, that have a point in the closed box from `min` to `max`.
///
/// Exact: a face whose box overlaps but which passes beside a corner is left out, one that only
/// touches the box is in. A box may be flat, a line or a point.
///
/// \pre    every corner is less than `mesh.points.size()`, every coordinate is finite
/// \throws std::invalid_argument when a coordinate of the box is not finite or min exceeds max
/// \cost   O(F) time
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::vector<std::uint32_t> faces_in_box(mesh_view mesh,
                                                                   const point3& min,
                                                                   const point3& max);

}  // namespace treeform
