#pragma once
/// \file
/// Triangles for a part of a plane that is given by its rim.

#include <libmesh/round/round_surface.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace treeform::detail::round {

/// A connected part of a plane, perhaps with holes and slits.
struct flat_region {
    static constexpr std::uint32_t no_line = std::numeric_limits<std::uint32_t>::max();

    /// A straight piece of the rim: the region is on its left as seen from where faces turn left.
    struct side {
        std::uint32_t from;
        std::uint32_t to;
        std::uint32_t line;  ///< equal for sides that are known to lie on one line, or `no_line`
    };

    std::uint32_t first_face = 0;  ///< the number of a face of it
    face plane{};                  ///< the corners of that face
    /// Or, instead of these: along which axis the plane is seen, and +1 where left is left from
    /// there, -1 where it is right.
    int axis = -1;
    int orientation = 1;
    std::vector<std::uint32_t> points{};  ///< that the triangles are to have, in any order, some
                                          ///< of them several times
    std::vector<side> rim{};
};

/// There are no triangles with a rim.
struct rim_fault : std::logic_error {
    using std::logic_error::logic_error;
};

/// Two of its sides cross each other.
struct sides_cross : rim_fault {
    sides_cross(std::size_t a, std::size_t b)
        : rim_fault("treeform: sides of a flat part of the surface cross"), a(a), b(b) {}
    std::size_t a, b;  ///< by number
};

/// The region as triangles between its points, near-Delaunay, oriented as `plane`: what the rim
/// winds around as seen along the axis, several times where it does so several times, and turned
/// over where it does so the other way.
///
/// \pre    no side has a point of the region but its ends, and all ends are among the points
/// \throws sides_cross where sides of the rim do
/// \throws rim_fault when the rim bounds nothing, or two points are one as seen so
/// \cost   about O(n^1.5) for n points
[[nodiscard]] std::vector<face> triangles_of(const exact_surface& surface,
                                             const flat_region& region);

}  // namespace treeform::detail::round
