#pragma once
/// \file
/// Removes thin faces that meet others from a surface.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace treeform::detail::round {

struct sliver_limits {
    double reach = 0.0;  ///< largest distance of elements that may be joined
    double thin =
        0.0;  ///< faces with a smaller height or a shorter edge count like faces that meet
    /// whether the faces bound a solid: opposite faces that cover each other are removed
    bool solid = true;
    std::span<const std::uint8_t> fixed{};  ///< [F] 1 for faces that must stay; or empty
    /// Approximate limit of the number of pairs of faces tested.
    std::uint64_t visits = std::numeric_limits<std::uint64_t>::max();
};

struct slivers_removed {
    std::vector<face> faces;
    std::vector<std::uint32_t>
        face_of;  ///< [F] the former face that contains the center of each, or is next to it
    std::vector<std::uint8_t> is_new;  ///< [F] 0 for unchanged faces
    std::uint64_t changes = 0;
    double moved = 0.0;  ///< largest distance of elements that were joined
    std::uint64_t visits = 0;
};

/// Where rounding makes faces meet, one of them is nearly always a sliver, thinner than points were
/// moved, or the faces are that close to each other. Four changes repair nearly all such cases,
/// each for elements within reach, nearest first:
/// - a corner is joined with another corner;
/// - an edge is split at a corner near it, so that a flat triangle is merged into its neighbors;
/// - a face is split at a corner near it;
/// - the edge between two nearly coplanar faces is flipped to the other diagonal.
///
/// All of them keep a closed surface closed, and do not move points. A change is kept only if, by
/// exact predicates, fewer faces meet or are thin than before; up to a hundred times, splits that
/// keep this number are also accepted, since the next change often needs them. So the algorithm
/// terminates, and never increases the number of faces that meet. Thick faces that cross stay, to
/// be cut later.
///
/// \param  meeting  all pairs of faces that meet; (f, f) for faces that are degenerate, or may be
///                  thin
/// \cost   O(F) for a tree over the faces; for each pair a few changes, each with one search in the
///         tree for each face at it
/// \same   on any number of threads
/// \source Milenkovic and Sacks, Two approximate Minkowski sum algorithms, IJCGA 20 (2010),
///         separate features before they round them
[[nodiscard]] slivers_removed remove_slivers(mesh_view surface, std::span<const face_pair> meeting,
                                             const sliver_limits& limits);

}  // namespace treeform::detail::round
