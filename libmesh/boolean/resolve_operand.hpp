#pragma once
/// \file
/// The set operations behind `resolve_self_intersections`.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>

namespace treeform::detail::boolean {

/// `split` of one mesh, and its union with nothing; errors name `resolve_self_intersections`.
[[nodiscard]] boolean_result resolve_by_split(mesh_view mesh, const boolean_options& options);
[[nodiscard]] boolean_result resolve_by_union(mesh_view mesh, const boolean_options& options);

}  // namespace treeform::detail::boolean
