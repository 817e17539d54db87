#pragma once
/// \file
/// Tetrahedra whose boundary is not a manifold, and more of them whose boundary is.

#include <libmesh/wrap/carving.hpp>

#include <cstdint>

namespace treeform::detail::wrap {

/// Takes tetrahedra from outside until what is inside and what is outside are of one piece each
/// around every corner, so that the faces between them are a manifold. Returns their number. Where
/// outside has several pieces around a corner, the largest stays; where inside has, the fewest
/// tetrahedra between two of its pieces go.
///
/// \cost O(V + T), and as many times for a corner as its tetrahedra change
[[nodiscard]] std::uint64_t fill_pinched_vertices(carved_space& space);

}  // namespace treeform::detail::wrap
