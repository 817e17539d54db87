#pragma once
/// \file
/// Escape rays: lines from a face of an arrangement out of the bounding box of everything.

#include <libmesh/arrange/corner_line.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/exact/implicit_point.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/aabb.hpp>

#include <array>
#include <cstddef>

namespace treeform::detail::arrange {

/// A line through a face of an arrangement, and the direction in which it leaves the box sooner.
struct escape_ray {
    corner_line line;
    bool ahead;
};

/// The escape ray of face f, along the axis on which the box ends soonest, preferably not nearly
/// parallel to the face.
/// \param mesh the mesh of which `cut` is the arrangement
[[nodiscard]] escape_ray find_escape_ray(mesh_view mesh, const mesh_arrangement& cut, std::size_t f,
                                         const aabb<double, 3>& box);

/// The same for given corners, and an input face `whole` that contains the face.
[[nodiscard]] escape_ray find_escape_ray(const std::array<implicit_point, 3>& corners,
                                         const triangle3& whole, const aabb<double, 3>& box);

}  // namespace treeform::detail::arrange
