#pragma once
/// \file
/// Trees over those faces of two meshes that may meet the other mesh, where both have been moved
/// to.

#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/build_within.hpp>

#include <string>
#include <utility>

namespace treeform::detail::intersect {

/// Over the boxes of moved faces: of those that reach into the box around the other mesh, moved, as
/// `build_overlap` says, or of all where most seem to. Corners are moved as anywhere else, so that
/// boxes hold what faces become, all roundings included; the trees are not to be moved any more.
///
/// \param function what the caller called
/// \throws std::invalid_argument when a transform is not finite, or naming the mesh and its lowest
///         face with a corner out of range or, as moved, not finite
/// \same   on any number of threads
[[nodiscard]] std::pair<tree<3>, tree<3>> overlap_trees(const std::string& function, mesh_view a,
                                                        mesh_view b,
                                                        const mesh_positions& positions);

}  // namespace treeform::detail::intersect
