#pragma once
/// \file
/// How much of a mesh an operation has lost.

#include <libmesh/repair/working_mesh.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstdint>
#include <span>

namespace treeform::detail::repair {

/// Volume where both are solids, else area.
struct loss {
    double before = 0.0;
    double after = 0.0;
    bool is_volume = false;

    [[nodiscard]] bool is_beyond(double share) const { return after < (1.0 - share) * before; }
};

/// What `made` has lost of `given`.
///
/// The volume of `given` is that of the solid that it is meant to be: with cracks closed, its faces
/// made to agree, overlaps counted once (`repair` without filling). Where that is open, area
/// counts: by how much it falls, but no more than what is lost (`lost_area`), so that neither what
/// a union hides nor what is filled in anew is a loss. Nothing is measured beyond 2^300.
///
/// \param is_left [F] whether `made` has a part of each face
/// \pre   no two faces of `made` meet
/// \cost  as `repair`
/// \same  on any number of threads
[[nodiscard]] loss find_loss(mesh_view given, std::span<const std::uint8_t> is_left, mesh_view made,
                             const progress_callback& progress);

/// The area of the faces of `given` of which nothing is left and that are neither on `made`, nor
/// inside its closed components.
///
/// Looked at in the middle of each face, in doubles: it is a bound on guesses, and decides nothing
/// about the mesh.
///
/// \param is_left [F] whether `made` has a part of each face
/// \cost  as `closest_point` and `locate` for the faces that are not left
/// \same  on any number of threads
[[nodiscard]] double lost_area(mesh_view given, std::span<const std::uint8_t> is_left,
                               mesh_view made);

/// Parts of which nothing is left.
struct vanished_parts {
    std::uint64_t lost = 0;    ///< that lost more than some area: they bound nothing
    std::uint64_t within = 0;  ///< that lost none: they were closed, within the solid
};

/// How many parts of `mesh`, by edges, have nothing left of them, by whether they lost more than
/// that area (`lost_area`) or none.
///
/// \param is_left [F] of the input, whether `made` has a part of each face
/// \pre   `made` is closed
[[nodiscard]] vanished_parts count_vanished(const working_mesh& mesh,
                                            std::span<const std::uint8_t> is_left, mesh_view made,
                                            double largest);

/// That of faces with the same corners once.
[[nodiscard]] double area_of_distinct(mesh_view mesh);

/// Whether a component, by vertices, has a negative volume.
[[nodiscard]] bool has_inward_component(mesh_view mesh);

}  // namespace treeform::detail::repair
