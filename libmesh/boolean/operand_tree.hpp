#pragma once
/// \file
/// The tree over the faces of operands before they are joined.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/tree.hpp>

#include <optional>
#include <span>

namespace treeform::detail::boolean {

/// The tree over the faces of one or two operands, counted through. As joining does not move them,
/// it is that of the joined faces; to build it first means that operands, joined ones and what a
/// build needs are never there all at once.
///
/// None of more operands, and none where `arrange_faces` would refuse a corner or leave out a face.
///
/// \pre  every corner is a point
/// \same on any number of threads
[[nodiscard]] std::optional<tree<3>> tree_of_operands(std::span<const mesh_view> operands);

}  // namespace treeform::detail::boolean
