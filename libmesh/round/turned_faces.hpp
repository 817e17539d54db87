#pragma once
/// \file
/// Finds the faces of a closed surface that were turned inside out.

#include <libmesh/arrange/corner_line.hpp>
#include <libmesh/round/near_edges.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace treeform::detail::round {

/// The winding number of further faces of a surface, just beside a face, on the side on which a
/// line through it is followed. Empty if there are no further faces.
using winding_of_rest = std::function<std::int64_t(const arrange::corner_line& line, bool ahead)>;

/// The faces of a solid whose winding numbers are not 1 behind and 0 in front, ascending: parts
/// that were turned inside out when points moved, or moved through another part, without meeting
/// anything now.
///
/// Exact. A part is a set of faces linked by edges of two faces; the winding number in front is the
/// same for all of it. It is 0 if the part has a face that did not move, and whose box meets no box
/// of a moved face: nothing crosses a point next to such a face while points move to their rounded
/// positions, since rounding is monotone, and everything beyond one side of a box of doubles stays
/// there. For every other part, all of which is near moved faces, the winding number is computed by
/// a ray.
///
/// \param near the moved faces, and those whose boxes meet one of theirs
/// \param rest further faces, none of which moved or meets the box of a moved face
/// \pre   the surface is closed, and its faces are not degenerate and meet only in common corners
///        and edges, before and after; before, all had the outside in front and the inside behind
/// \cost  O(N log N) for N near faces; if there are parts without an unmoved face, a tree over the
///        surface and a query for each
/// \same  on any number of threads
[[nodiscard]] std::vector<std::uint32_t> find_turned_faces(mesh_view surface,
                                                           const near_edges& near,
                                                           const winding_of_rest& rest = {});

}  // namespace treeform::detail::round
