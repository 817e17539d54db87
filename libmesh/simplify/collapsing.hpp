#pragma once
/// \file
/// Edge collapses, each subject to all checks.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/simplify.hpp>

namespace treeform::detail::simplify {

/// Like `treeform::simplify`, without the treatment of solids.
[[nodiscard]] simplify_result collapse_edges(mesh_view given, double distance,
                                             const simplify_options& options);

}  // namespace treeform::detail::simplify
