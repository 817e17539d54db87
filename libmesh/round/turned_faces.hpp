#pragma once
/// \file
/// Faces of a closed surface that have their outside behind them.

#include <libmesh/arrange/corner_line.hpp>
#include <libmesh/round/near_edges.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace treeform::detail::round {

/// How often faces that a surface has besides those given wind around what is right beside a face,
/// on the side where a line through it is followed. Empty where there are none.
using winding_of_rest = std::function<std::int64_t(const arrange::corner_line& line, bool ahead)>;

/// The faces of a solid that it does not wind around once behind them and not at all in front, as
/// part of it was turned inside out when its points moved, or has passed another part, and still
/// meets nothing; ascending.
///
/// A part is connected along edges of two faces; there is one winding number in front of all of it.
/// It is 0 if it has a face that has not moved and whose box meets no box of a face that has: a
/// point next to such a face is met by nothing on its way from the exact places to the rounded
/// ones, as rounding is monotone, and what lies beyond one side of a box of doubles stays there. A
/// line tells of each loose part, all of which is near what has moved. Exact.
///
/// \param near the faces that have moved and all whose boxes meet one of theirs
/// \param rest faces left out, none of which has moved or meets a box of a face that has
/// \pre   the surface is closed, and its faces have an area and meet in common corners and edges
///        only, where they were and where they are; before, all had the outside in front and the
///        inside behind
/// \cost  O(N log N) for N faces near; where parts are loose, a tree over the surface and a query
///        for each
/// \same  on any number of threads
[[nodiscard]] std::vector<std::uint32_t> find_turned_faces(mesh_view surface,
                                                           const near_edges& near,
                                                           const winding_of_rest& rest = {});

}  // namespace treeform::detail::round
