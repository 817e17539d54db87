#pragma once
/// \file
/// Escape rays: lines from faces of an arrangement out of everything, to where nothing is.

#include <libmesh/arrange/corner_line.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/exact/implicit_point.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/aabb.hpp>

#include <array>
#include <cstddef>

namespace treeform::detail::arrange {

/// A line through a face of an arrangement, and which way along it less of a box is.
struct escape_ray {
    corner_line line;
    bool ahead;
};

/// Along the axis on which the box ends soonest, of those that the face is not too steep to, if
/// there is one.
/// \param mesh what `cut` is the arrangement of
[[nodiscard]] escape_ray find_escape_ray(mesh_view mesh, const mesh_arrangement& cut, std::size_t f,
                                         const aabb<double, 3>& box);

/// The same from its corners, and a face that it lies in.
[[nodiscard]] escape_ray find_escape_ray(const std::array<implicit_point, 3>& corners,
                                         const triangle3& whole, const aabb<double, 3>& box);

}  // namespace treeform::detail::arrange
