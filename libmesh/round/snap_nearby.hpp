#pragma once
/// \file
/// Points, edges and faces of a surface that all but meet are made to meet.

#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::round {

struct joined_near {
    mesh surface;                        ///< points as they were, with their numbers
    std::vector<std::uint32_t> face_of;  ///< [F] face that each one was, or was a part of
    double moved = 0.0;                  ///< bound of how far anything was moved
};

struct joint {
    double reach = 0.0;  ///< what is nearer than this is joined
    /// [F] faces with the same number lie in one plane, except for rounding.
    std::span<const std::uint32_t> source{};
    bool solid = true;  ///< the faces bound a solid: what covers each other back to back goes
    /// [F], or empty: the faces are those of several operands, which may pass through each other.
    /// Then none goes that has three corners, and edges that pass each other are left to be cut.
    std::span<const std::uint32_t> operand{};
};

/// Joins corners within reach of each other to the lower one; splits offending edges, with all
/// faces at them, and offending faces at corners next to them, and edges where they pass each
/// other, with new points at the end of the others if need be; flat patches of offending faces then
/// get triangles that their points decide. Several times, as long as something is near. Faces that
/// lose a corner by it vanish; of several with the same corners one stays, or, of a solid, what
/// does not cancel.
///
/// What the surface winds around changes near the joints only; it runs along its edges as often one
/// way as the other if it did before. Nothing is decided here that would have to be right:
/// distances are computed in double.
///
/// \param  offending  [F]
/// \same   on any number of threads
[[nodiscard]] joined_near snap_nearby(mesh_view mesh, std::span<const std::uint8_t> offending,
                                      const joint& how);

}  // namespace treeform::detail::round
