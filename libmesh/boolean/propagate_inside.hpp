#pragma once
/// \file
/// Which faces of two solids' surfaces lie in the other solid.

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/boolean/near_faces.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// [F'] 1 for faces of `cut`, the arrangement of `near.local`, that one operand covers and that lie
/// inside the other; 0 for the others.
///
/// Each operand has outside in front of its faces and inside behind: then no cells are needed.
/// Faces with a common point that is not on the other surface are inside alike. So are faces at an
/// edge none of which is the other operand's. Where some are, the nearest of them about the edge
/// tells. What has no contact is told by a ray.
///
/// None where the faces contradict each other: an operand is not sound.
///
/// \throws std::invalid_argument when an operand is open that a ray is asked of
/// \cost   O(V' + F'), a sort of the faces about the edges at which the surfaces meet, and a ray
///         for each set of faces of which nothing else is known
/// \same   on any number of threads
[[nodiscard]] std::optional<std::vector<std::uint8_t>> find_insides(const prepared_pair& operands,
                                                                    const near_faces& near,
                                                                    const mesh_arrangement& cut);

}  // namespace treeform::detail::boolean
