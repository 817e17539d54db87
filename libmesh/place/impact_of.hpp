#pragma once
/// \file
/// When a mesh in motion meets another, or comes near it, with the trees of both.

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

/// As `time_of_impact`; `cancelled`, too, where the effort does not suffice. `exact` is the exact
/// time, that of the first contact.
///
/// \pre the trees are those of the meshes
[[nodiscard]] TREEFORM_API impact impact_of(mesh_view a, const tree<3>& tree_a, mesh_view b,
                                            const tree<3>& tree_b, const point3& motion,
                                            const impact_options& options = {},
                                            base::effort* effort = nullptr,
                                            sweep_contact* exact = nullptr);

/// As `time_to_distance`, with an effort likewise, which looking where it starts does not spend.
///
/// \pre the trees are those of the meshes
[[nodiscard]] TREEFORM_API impact approach_of(mesh_view a, const tree<3>& tree_a, mesh_view b,
                                              const tree<3>& tree_b, const point3& motion,
                                              double distance, const impact_options& options = {},
                                              base::effort* effort = nullptr);

}  // namespace treeform::detail::place
