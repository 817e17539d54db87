#pragma once
/// \file
/// The closest points of two meshes with prebuilt trees.

#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/tree.hpp>

#include <limits>
#include <optional>

namespace treeform::detail::nearness {

/// Like `treeform::closest_pair`, for trees over the boxes of the faces, each with an optional
/// transform.
///
/// \pre    coordinates of corners are finite; the trees are over the faces of the meshes
/// \throws std::invalid_argument when the size of a tree is not the number of faces of its mesh, or
///         the radius is negative or NaN
[[nodiscard]] TREEFORM_API std::optional<closest_pair_result> closest_pair(
    mesh_view a, const transformed<3>& tree_a, mesh_view b, const transformed<3>& tree_b,
    double radius = std::numeric_limits<double>::infinity());

}  // namespace treeform::detail::nearness
