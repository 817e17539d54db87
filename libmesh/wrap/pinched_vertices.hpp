#pragma once
/// \file
/// Makes the boundary of a set of tetrahedra manifold.

#include <libmesh/wrap/carving.hpp>

#include <cstdint>

namespace treeform::detail::wrap {

/// Moves tetrahedra from outside to inside until, around every corner, the inside and the outside
/// are each connected, so that the faces between them form a manifold. Returns the number of
/// tetrahedra moved. If the outside has several components around a corner, the largest stays
/// outside; if the inside has, the fewest tetrahedra that connect two of its components are moved.
///
/// \cost O(V + T); each corner is processed again whenever one of its tetrahedra changes
[[nodiscard]] std::uint64_t fill_pinched_vertices(carved_space& space);

}  // namespace treeform::detail::wrap
