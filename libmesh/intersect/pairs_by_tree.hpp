#pragma once
/// \file
/// Self-intersections of a mesh whose tree is there.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/detail/function_ref.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <limits>

namespace treeform::detail::intersect {

/// As `self_intersections`; `tree` is that of the faces, and is gone when all has been found.
/// \pre all that `self_intersections` checks
[[nodiscard]] intersection_result pairs_by_tree(mesh_view mesh, tree<3>&& tree,
                                                const intersection_options& options);

/// Which of the pairs that meet are wanted. Called by many threads.
using wanted_pairs = function_ref<bool(const face_pair& pair)>;

/// The same of a tree that stays, and of the pairs that `wanted` takes, where it is given: no list
/// of the others is made, but counts include them. Where there are more pairs than `most`, some of
/// them, more than that.
[[nodiscard]] intersection_result pairs_by_tree(
    mesh_view mesh, const tree<3>& tree, const intersection_options& options,
    std::size_t most = std::numeric_limits<std::size_t>::max(),
    const wanted_pairs* wanted = nullptr);

}  // namespace treeform::detail::intersect
