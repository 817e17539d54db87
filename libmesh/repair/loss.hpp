#pragma once
/// \file
/// Measures how much of a mesh an operation lost.

#include <libmesh/repair/working_mesh.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstdint>
#include <span>

namespace treeform::detail::repair {

/// Volumes if both meshes are solids, else areas.
struct loss {
    double before = 0.0;
    double after = 0.0;
    bool is_volume = false;

    [[nodiscard]] bool is_beyond(double share) const { return after < (1.0 - share) * before; }
};

/// The loss of `made` compared with `given`.
///
/// The volume of `given` is that of the intended solid: with cracks closed, faces oriented
/// consistently, and overlaps counted once (`repair` without filling). If that is open, areas are
/// compared: the decrease of the area, but at most the lost area (`lost_area`), so that neither
/// faces hidden in a union nor new fillings count as a loss. Nothing is measured for coordinates
/// beyond 2^300.
///
/// \param is_kept [F] whether `made` has a part of each face
/// \pre   no two faces of `made` meet
/// \cost  as `repair`
/// \same  on any number of threads
[[nodiscard]] loss find_loss(mesh_view given, std::span<const std::uint8_t> is_kept, mesh_view made,
                             const progress_callback& progress);

/// The area of the faces of `given` of which nothing is left, and which are neither on `made` nor
/// inside its closed components.
///
/// Tested at the center of each face, in doubles: a limit for heuristics, which decides nothing
/// about the mesh.
///
/// \param is_kept [F] whether `made` has a part of each face
/// \cost  as `closest_point` and `locate` for the faces that are not left
/// \same  on any number of threads
[[nodiscard]] double lost_area(mesh_view given, std::span<const std::uint8_t> is_kept,
                               mesh_view made);

/// Numbers of parts of which nothing is left.
struct vanished_parts {
    std::uint64_t lost = 0;    ///< parts that lost more than `largest` area: they bound nothing
    std::uint64_t within = 0;  ///< parts that lost no area: they were closed, within the solid
};

/// Counts the parts of `mesh` (faces linked by edges) of which nothing is left, by whether they
/// lost more than `largest` area (`lost_area`) or none.
///
/// \param is_kept [F] of the input, whether `made` has a part of each face
/// \pre   `made` is closed
[[nodiscard]] vanished_parts count_vanished(const working_mesh& mesh,
                                            std::span<const std::uint8_t> is_kept, mesh_view made,
                                            double largest);

/// The area of the mesh, with faces of the same corners counted once.
[[nodiscard]] double area_of_distinct(mesh_view mesh);

/// Whether a component (faces linked by vertices) has a negative volume.
[[nodiscard]] bool has_inward_component(mesh_view mesh);

}  // namespace treeform::detail::repair
