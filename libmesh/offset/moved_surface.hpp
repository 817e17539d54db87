#pragma once
/// \file
/// Moves a surface along its normals.

#include <treeform/mesh/mesh.hpp>

namespace treeform::detail::offset {

/// Moves each vertex along the angle-weighted mean of the face normals at it, by `by` divided by
/// the mean cosine between this direction and the face normals; by at most twice `by`. Points with
/// equal coordinates are joined, and faces refer to the joined points.
///
/// \throws std::invalid_argument naming a face that has an edge in the same direction as another
///         face
[[nodiscard]] mesh moved_to_front(mesh_view surface, double by);

}  // namespace treeform::detail::offset
