#pragma once
/// \file
/// Holes through the wall of a hollow solid.

#include <treeform/mesh/mesh.hpp>

namespace treeform::detail::offset {

/// The material that a drain removes.
struct drilled {
    mesh prism;
    /// one end is outside of the solid and the other in a cavity, decided exactly
    bool leads = false;
};

/// A hole along the shortest segment from the point of the surface nearest to `at` to the cavities.
/// It extends beyond both ends by its diameter, but by no more than half of the distance to the
/// next surface there.
///
/// \pre both meshes have faces, and do not meet
[[nodiscard]] drilled drill(const point3& at, double diameter, const prepared_mesh& solid,
                            const prepared_mesh& cavities);

}  // namespace treeform::detail::offset
