#pragma once
/// \file
/// How much of a surface is hidden, and how densely it meets itself, from a few faces.

#include <libmesh/boolean/partial_expression.hpp>
#include <libmesh/boolean/surface_components.hpp>

namespace treeform::detail::boolean {

/// Means over 64 faces that are spread over all.
struct face_samples {
    /// The share at which components that do not seem to cross them decide the expression, whatever
    /// all others do: about what a division of space can leave out. A face counts once for itself
    /// and once for each neighbor, as it costs to cut: hidden ones that nothing is near cost
    /// little.
    double hidden = 0.0;
    double neighbors = 0.0;  ///< faces of other components whose boxes overlap theirs
};

/// \param at_nowhere the expression where nothing is known to wind around anything
/// \cost  for each face, eight lines through components whose boxes they begin in
/// \same  on any number of threads
[[nodiscard]] face_samples sample_faces(const surface_components& components,
                                        const partial_expression& at_nowhere);

}  // namespace treeform::detail::boolean
