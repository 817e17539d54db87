#pragma once
/// \file
/// Self-intersections of a mesh with a given tree.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/detail/function_ref.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <limits>

namespace treeform::detail::intersect {

/// As `self_intersections`, with the tree over the faces, which is freed at the end.
/// \pre the conditions that `self_intersections` checks
[[nodiscard]] face_pair_result pairs_by_tree(mesh_view mesh, tree<3>&& tree,
                                             const face_pair_options& options);

/// Whether a pair that meets is wanted. Called from several threads.
using wanted_pairs = function_ref<bool(const face_pair& pair)>;

/// The same with a tree that is kept. If `wanted` is not null, only pairs for which it returns true
/// are listed, but all are counted. If there are more pairs than `most`, the search stops with some
/// more than `most`.
[[nodiscard]] face_pair_result pairs_by_tree(
    mesh_view mesh, const tree<3>& tree, const face_pair_options& options,
    std::size_t most = std::numeric_limits<std::size_t>::max(),
    const wanted_pairs* wanted = nullptr);

}  // namespace treeform::detail::intersect
