#pragma once
/// \file
/// Thin faces that meet others are taken out of a surface.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::round {

struct sliver_limits {
    double reach = 0.0;  ///< edges and heights of faces up to this long may go
    double thin = 0.0;   ///< faces of less height are as bad as faces that meet
    bool solid = true;   ///< the faces bound a solid: what covers each other back to back goes
};

struct slivers_removed {
    std::vector<face> faces;
    std::vector<std::uint32_t> face_of;  ///< [F] face that each one was, or was a part of
    std::vector<std::uint8_t> is_new;    ///< [F] 1 for faces with other corners than that one had
    std::uint64_t changes = 0;
    double moved = 0.0;  ///< length of the longest edge or height that went
};

/// Where faces meet, one of them is nearly always thinner than rounding moved its corners. Such
/// faces go, by two changes, smallest first: one end of a short edge becomes the other; or the edge
/// below a corner gets that corner, which turns a flat triangle into its neighbors. Both keep a
/// closed surface closed. Points stay where they are.
///
/// A change is kept only if afterwards, by exact predicates, fewer faces meet or are thin than
/// before. So it ends, and leaves nothing worse than it was. What no change helps stays: two
/// thick faces that meet have to be cut.
///
/// \param  meeting  all pairs of faces that meet; (f, f) for faces without an area
/// \cost   O(F) for a tree over the faces, and for each pair a few searches in it
/// \same   on any number of threads
/// \source features are separated before they are rounded in Milenkovic and Sacks, Two approximate
///         Minkowski sum algorithms, IJCGA 20 (2010)
[[nodiscard]] slivers_removed remove_slivers(mesh_view surface, std::span<const face_pair> meeting,
                                             const sliver_limits& limits);

}  // namespace treeform::detail::round
