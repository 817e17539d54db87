#pragma once
/// \file
/// Whether an operand bounds a solid, and whether it does without a second look.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/parallel.hpp>

namespace treeform::detail::boolean {

/// As `treeform::check_solid`; errors name the function `called`.
[[nodiscard]] certificate check_solid(const char* called, mesh_view mesh,
                                      const progress_callback& progress = {});

/// Thrown where `progress` asked to stop: the mesh then keeps no answer.
struct stopped {};

/// Whether two faces of `mesh` have a common corner, a common edge or nothing in common, none is
/// degenerate, no two vertices have equal coordinates, every edge is closed, and what is behind the
/// faces is inside: as of what `boolean` has certified. The mesh keeps the answer. False also for
/// some that are: with a vertex of more than 64 faces, or all but no volume.
///
/// \throws std::invalid_argument naming a face with a corner out of range; stopped
/// \cost   once, that of `self_intersections` and half as much
/// \same   on any number of threads
[[nodiscard]] bool is_sound(const prepared_mesh& mesh, const progress_callback& progress);

}  // namespace treeform::detail::boolean
