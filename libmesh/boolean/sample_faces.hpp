#pragma once
/// \file
/// Estimates, from a few faces, how much of a surface is hidden, and how densely it intersects
/// itself.

#include <libmesh/boolean/partial_expression.hpp>
#include <libmesh/boolean/surface_components.hpp>

namespace treeform::detail::boolean {

/// Means over 64 evenly spread faces.
struct face_samples {
    /// Share of the faces at which components that seem not to cross them decide the expression,
    /// regardless of all others: about the share that a division of space can omit. Faces are
    /// weighted by 1 plus their neighbors, which is about the cost of cutting them.
    double hidden = 0.0;
    double neighbors = 0.0;  ///< number of faces of other components with overlapping boxes
};

/// \param at_nowhere the expression with all winding numbers unknown
/// \cost  for each face, eight rays through the components whose boxes contain their origin
/// \same  on any number of threads
[[nodiscard]] face_samples sample_faces(const surface_components& components,
                                        const partial_expression& at_nowhere);

}  // namespace treeform::detail::boolean
