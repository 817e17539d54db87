#pragma once
/// \file
/// Groups of points split so that merging them keeps a surface a surface.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/weld.hpp>

#include <cstdint>

namespace treeform::detail::weld {

struct manifold_groups {
    point_groups groups;         ///< each within a group given
    std::uint64_t split_up = 0;  ///< groups given that were not left whole
};

/// Splits groups as `weld` says under `keep_manifold`: first those of equal coordinates, then
/// those of what has come of these, so that a group that must stay apart does not tear its faces
/// from each other. After `rounds` rounds of splitting, all groups of a component of the welded
/// mesh that still has a fault are split into single points.
///
/// \pre  every corner is a point, every point is in a group
/// \throws std::invalid_argument for more than 2^32 / 3 faces
/// \cost O(V + F log d) time a round for at most d edges at a point; one round where points were
///       manifold before and no face shrinks
/// \same on any number of threads
[[nodiscard]] manifold_groups split_to_manifold(mesh_view mesh, const point_groups& given,
                                                int rounds = 32);

}  // namespace treeform::detail::weld
