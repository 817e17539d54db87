#pragma once
/// \file
/// The nearest points of two meshes whose trees are known.

#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/tree.hpp>

#include <limits>
#include <optional>

namespace treeform::detail::nearness {

/// As `treeform::closest_points`; the trees are those of the faces' boxes, and may be treated as
/// transformed.
///
/// \pre    coordinates of corners are finite, the trees are those of the meshes' faces
/// \throws std::invalid_argument when a tree has another size than its mesh, or the radius is
///         negative or NaN
[[nodiscard]] TREEFORM_API std::optional<closest_points_result> closest_points(
    mesh_view a, const transformed<3>& tree_a, mesh_view b, const transformed<3>& tree_b,
    double radius = std::numeric_limits<double>::infinity());

}  // namespace treeform::detail::nearness
