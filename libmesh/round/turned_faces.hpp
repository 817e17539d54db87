#pragma once
/// \file
/// Faces of a closed surface that have their outside behind them.

#include <libmesh/round/near_edges.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::round {

/// Whether a part of a solid's surface may have been turned inside out by the moves of its points,
/// or have passed another part, and still meet nothing.
///
/// A part is connected along edges of two faces. It is none of these if it has a face that has not
/// moved and whose box meets no box of a face that has. A point next to such a face is met by
/// nothing on its way from the exact places to the rounded ones: rounding is monotone, so what lies
/// beyond one side of a box of doubles stays there. The surface winds around it as before.
///
/// Nor is a loose part, all of which is near what has moved, if it is closed, has a volume that the
/// moves cannot turn to its opposite, and a corner that is in no box of another part.
///
/// \param  sound  [F] 1 for faces that have not moved
/// \param  near   of the other faces and all whose boxes meet one of theirs. Where only a region of
///                a surface is given, the faces left out meet no box of a face that has moved
/// \param  moved  how far points have moved at most, in each coordinate; infinite where points
///                have become one, or faces have vanished
/// \pre    the surface is closed, and its faces meet in common corners and edges only, where they
///         were and where they are; before, all had the outside in front and the inside behind
/// \cost   O(N log N) for N faces near
/// \same   on any number of threads
[[nodiscard]] bool may_be_turned(mesh_view surface, std::span<const std::uint8_t> sound,
                                 const near_edges& near, double moved);

struct turned_faces {
    std::vector<std::uint32_t> faces;  ///< ascending
    bool open = false;                 ///< the surface is: then nothing else is told
};

/// The faces around which the surface does not wind once behind and not at all in front: exact.
///
/// \pre  faces have an area and meet in common corners and edges only
/// \cost as `find_cells`
/// \same on any number of threads
[[nodiscard]] turned_faces find_turned_faces(mesh_view surface);

}  // namespace treeform::detail::round
