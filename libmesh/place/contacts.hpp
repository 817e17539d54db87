#pragma once
/// \file
/// Contacts of a mesh with the fixed meshes.

#include <libmesh/place/shape.hpp>
#include <libmesh/place/surroundings.hpp>
#include <libmesh/place/sweep_among.hpp>
#include <treeform/mesh/placement.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace treeform::detail::place {

/// The contacts at the end of a motion.
[[nodiscard]] std::vector<placement_contact> contacts_of(const shape& moving,
                                                         const chosen_parts& parts,
                                                         const sweep_result& met,
                                                         const point3& motion);

/// Pairs of a face of `there`, a moved mesh, and a face of a fixed mesh that meet: at most `limit`
/// for each fixed mesh. `count` receives the number of all pairs.
[[nodiscard]] std::vector<placement_contact> contacts_at(const shape& there,
                                                         const surroundings& among,
                                                         std::size_t limit, std::uint64_t& count);

/// The face with the lowest number that has the lowest point of `mesh`; empty without faces.
[[nodiscard]] std::optional<placement_contact> contact_with_bed(mesh_view mesh);

}  // namespace treeform::detail::place
