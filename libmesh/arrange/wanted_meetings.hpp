#pragma once
/// \file
/// Meetings of faces that an arrangement can do without.

#include <libmesh/intersect/meetings.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/function_ref.hpp>

namespace treeform::detail::arrange {

/// Whether something is wanted of what is in a box. Called on several threads at once.
using is_box_wanted = function_ref<bool(const aabb<double, 3>&)>;

/// Leaves out the meetings around which no box is wanted, and then the names that no meeting has any
/// more. The order stays.
///
/// \param given the points of the mesh
/// \same  on any number of threads
void keep_wanted(intersect::mesh_meetings& met, points_view given, const is_box_wanted& is_wanted);

}  // namespace treeform::detail::arrange
