#pragma once
/// \file
/// The time at which a moving mesh meets another mesh or comes within a distance of it, with
/// prebuilt trees of both.

#include <libmesh/base/effort.hpp>
#include <libmesh/geometry/contact_order.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/time_of_impact.hpp>
#include <treeform/tree/tree.hpp>

namespace treeform::detail::place {

/// The greatest double that is not beyond the exact time of a contact.
///
/// \pre `contact` was returned by `time_of_impact` for `motion`
[[nodiscard]] double time_not_beyond(const sweep_contact& contact, const point3& motion);

/// Like `time_of_impact`; also `cancelled` when the effort is exhausted. `exact` receives the first
/// contact, which has the exact time.
///
/// \pre the trees are those of the meshes
[[nodiscard]] TREEFORM_API impact impact_of(mesh_view a, const tree<3>& tree_a, mesh_view b,
                                            const tree<3>& tree_b, const point3& motion,
                                            const impact_options& options = {},
                                            base::effort* effort = nullptr,
                                            sweep_contact* exact = nullptr);

/// Like `time_to_distance`, with the same limit on effort; the check of the start position does not
/// count toward it.
///
/// \pre the trees are those of the meshes
[[nodiscard]] TREEFORM_API impact approach_of(mesh_view a, const tree<3>& tree_a, mesh_view b,
                                              const tree<3>& tree_b, const point3& motion,
                                              double distance, const impact_options& options = {},
                                              base::effort* effort = nullptr);

}  // namespace treeform::detail::place
