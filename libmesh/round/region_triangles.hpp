#pragma once
/// \file
/// Triangulates a region of a plane that is given by its rim.

#include <libmesh/round/round_surface.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace treeform::detail::round {

/// A connected region of a plane, perhaps with holes and slits.
struct flat_region {
    static constexpr std::uint32_t no_line = std::numeric_limits<std::uint32_t>::max();

    /// A straight piece of the rim, with the region on its left, seen from where faces are
    /// counter-clockwise.
    struct side {
        std::uint32_t from;
        std::uint32_t to;
        std::uint32_t line;  ///< equal for sides known to lie on one line; or `no_line`
    };

    std::uint32_t first_face = 0;  ///< number of a face in the region
    face plane{};                  ///< the corners of that face
    /// Instead of these two: the axis of the projection, and its orientation: +1 if left remains
    /// left, -1 if it becomes right.
    int axis = -1;
    int orientation = 1;
    /// points of the triangles, in any order, perhaps repeated
    std::vector<std::uint32_t> points{};
    std::vector<side> rim{};
};

/// Thrown if a rim cannot be triangulated.
struct rim_fault : std::logic_error {
    using std::logic_error::logic_error;
};

/// Thrown if two sides of the rim cross.
struct sides_cross : rim_fault {
    sides_cross(std::size_t a, std::size_t b)
        : rim_fault("treeform: sides of a flat part of the surface cross"), a(a), b(b) {}
    std::size_t a, b;  ///< numbers of the sides
};

/// The triangles of the region, nearly Delaunay, oriented as `plane`: the area around which the rim
/// winds in projection along the axis. An area with winding number n has n copies, flipped if n is
/// negative.
///
/// \pre    no side contains a point of the region except its ends, and all ends are among the
///         points
/// \throws sides_cross if sides of the rim cross
/// \throws rim_fault if the rim bounds nothing, or two points have the same projection
/// \cost   about O(n^1.5) for n points
[[nodiscard]] std::vector<face> triangles_of(const exact_surface& surface,
                                             const flat_region& region);

}  // namespace treeform::detail::round
