#pragma once
/// \file
/// Holes through the wall of a hollow solid.

#include <treeform/mesh/mesh.hpp>

namespace treeform::detail::offset {

/// What a drain takes away.
struct drilled {
    mesh prism;
    bool leads = false;  ///< its ends are outside the solid and in a cavity, exactly
};

/// Along the shortest way from the point of the surface nearest to `at` to the cavities, and
/// as far beyond both as the hole is wide, but no more than half of the way to what is next there.
///
/// \pre both have faces, and no point in common
[[nodiscard]] drilled drill(const point3& at, double diameter, const prepared_mesh& solid,
                            const prepared_mesh& cavities);

}  // namespace treeform::detail::offset
