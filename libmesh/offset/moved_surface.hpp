#pragma once
/// \file
/// A surface moved to one of its sides.

#include <treeform/mesh/mesh.hpp>

namespace treeform::detail::offset {

/// Vertices moved along the mean of the normals around them, by angle, each by `by` over the cosine
/// between that and the faces, as the mean has it; by twice `by` at most. Points with equal
/// coordinates are one, with the corners that faces then have.
///
/// \throws std::invalid_argument naming a face that runs along an edge as another one does
[[nodiscard]] mesh moved_to_front(mesh_view surface, double by);

}  // namespace treeform::detail::offset
