#pragma once
/// \file
/// Trees over the faces of two transformed meshes that may meet the other mesh.

#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/build_within.hpp>

#include <string>
#include <utility>

namespace treeform::detail::intersect {

/// Trees over the boxes of transformed faces: only those that reach into the box around the other
/// transformed mesh (`build_overlap`), or all faces if most seem to. Corners are transformed and
/// rounded as elsewhere, so boxes contain the rounded faces exactly; the trees must not be
/// transformed again.
///
/// \param function the name of the called function, for messages
/// \throws std::invalid_argument if a transform is not finite; naming the mesh and its lowest face
///         with a corner that is out of range or, after the transform, not finite
/// \same   on any number of threads
[[nodiscard]] std::pair<tree<3>, tree<3>> overlap_trees(const std::string& function, mesh_view a,
                                                        mesh_view b,
                                                        const mesh_pair_options& positions);

}  // namespace treeform::detail::intersect
