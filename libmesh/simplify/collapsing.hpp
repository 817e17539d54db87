#pragma once
/// \file
/// Edges collapsed as long as all checks are passed.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/simplify.hpp>

namespace treeform::detail::simplify {

/// As `treeform::simplify`, of which solids are not looked at.
[[nodiscard]] simplify_result collapse_edges(mesh_view given, double distance,
                                             const simplify_options& options);

}  // namespace treeform::detail::simplify
