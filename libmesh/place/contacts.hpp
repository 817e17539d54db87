#pragma once
/// \file
/// Where a mesh meets what is fixed.

#include <libmesh/place/shape.hpp>
#include <libmesh/place/surroundings.hpp>
#include <libmesh/place/sweep_among.hpp>
#include <treeform/mesh/placement.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace treeform::detail::place {

/// Contacts that a motion has led to.
[[nodiscard]] std::vector<placement_contact> contacts_of(const shape& moving,
                                                         const chosen_parts& parts,
                                                         const sweep_result& met,
                                                         const point3& motion);

/// Pairs of faces of `there`, a mesh at some place, that meet one of a fixed mesh: at most `limit`
/// of each. `count` gets the number of all.
[[nodiscard]] std::vector<placement_contact> contacts_at(const shape& there,
                                                         const surroundings& among,
                                                         std::size_t limit, std::uint64_t& count);

/// The lowest face with the lowest point of `mesh`; none without faces.
[[nodiscard]] std::optional<placement_contact> contact_with_bed(mesh_view mesh);

}  // namespace treeform::detail::place
