#pragma once
/// \file
/// Thin faces that meet others are taken out of a surface.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace treeform::detail::round {

struct sliver_limits {
    double reach = 0.0;  ///< what is no further apart than this may be joined
    double thin =
        0.0;  ///< faces with less height, or a shorter edge, are as bad as faces that meet
    bool solid = true;  ///< the faces bound a solid: what covers each other back to back goes
    std::span<const std::uint8_t> fixed{};  ///< [F] 1 for faces that are to stay; or empty
    /// About as many pairs of faces are held against each other.
    std::uint64_t visits = std::numeric_limits<std::uint64_t>::max();
};

struct slivers_removed {
    std::vector<face> faces;
    std::vector<std::uint32_t>
        face_of;                       ///< [F] face that the middle of each one lies in, or next to
    std::vector<std::uint8_t> is_new;  ///< [F] 0 for faces that are as they were
    std::uint64_t changes = 0;
    double moved = 0.0;  ///< furthest apart of what was joined
    std::uint64_t visits = 0;
};

/// Where rounding makes faces meet, one of them is nearly always thinner than points were moved: a
/// sliver. Others lie that close to each other. Four changes mend nearly all of it, each
/// where things are within reach, nearest first:
/// - a corner becomes another one;
/// - an edge gets a corner that is above it, so that a flat triangle goes into its neighbors;
/// - a face gets a corner that is above it;
/// - the edge between two faces that are all but coplanar is turned into their other diagonal.
///
/// All of them keep a closed surface closed, and points stay where they are. A change is kept only
/// if by exact predicates fewer faces meet, or are thin, than before; a hundred times, corners are
/// also put into edges and faces where as many do, as the next change often needs that. So it ends,
/// and leaves no more that meets than there was. Thick faces that cross stay, to be cut.
///
/// \param  meeting  all pairs of faces that meet; (f, f) for those without an area or that may be
///                  thin
/// \cost   O(F) for a tree over the faces; for each pair a few changes, each as many searches in
///         the tree as there are faces at it
/// \same   on any number of threads
/// \source Milenkovic and Sacks, Two approximate Minkowski sum algorithms, IJCGA 20 (2010),
///         separate features before they round them
[[nodiscard]] slivers_removed remove_slivers(mesh_view surface, std::span<const face_pair> meeting,
                                             const sliver_limits& limits);

}  // namespace treeform::detail::round
