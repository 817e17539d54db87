#pragma once
/// \file
/// Faces that agree on what is outside.

#include <libmesh/repair/working_mesh.hpp>

#include <cstdint>

namespace treeform::detail::repair {

/// Turns faces until two that have an edge to themselves run along it opposite ways; returns how
/// many. Of each patch, the fewer are turned, and of as many, not the lowest face. A patch with one
/// side only, as the Moebius strip, stays as it is.
///
/// \cost O(V + F)
/// \same on any number of threads
std::uint64_t make_faces_agree(working_mesh& mesh);

/// What is turned as one: all that edges link, or shells (`shells`), of which several may touch
/// along edges. Shells are for meshes that disagreed there: else what runs along an edge says what
/// is meant, and a shell may be a wedge where the surface passes through itself.
enum class turned_as_one : std::uint8_t { component, shell };

/// Turns closed components outward that have a negative volume and lie inside no other; returns
/// how many. A component is closed when its faces run as often one way as the other along each
/// edge. What lies inside of one is turned with it, if from outside every second one is inward: a
/// solid with cavities, inside out. Cavities stay inside of what was filled, whether or not the
/// filling passes through them.
///
/// \cost O(V + F); for a component turned inward, a winding number around each one whose box holds
///       its own
/// \same on any number of threads
std::uint64_t turn_outward(working_mesh& mesh, turned_as_one what);

/// Whether every closed component has a positive volume.
[[nodiscard]] bool is_outward(const working_mesh& mesh, turned_as_one what);

/// Whether the others wind once around every component that has a negative volume, and not around
/// any that has a positive one, so that each bounds what is inside.
///
/// \pre no two components meet
[[nodiscard]] bool is_well_nested(const working_mesh& mesh);

}  // namespace treeform::detail::repair
