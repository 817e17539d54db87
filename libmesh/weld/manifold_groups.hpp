#pragma once
/// \file
/// Splits groups of points so that merging them keeps a surface manifold.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/weld.hpp>

#include <cstdint>

namespace treeform::detail::weld {

struct manifold_groups {
    point_groups groups;         ///< each is a subset of a given group
    std::uint64_t split_up = 0;  ///< number of given groups that were split
};

/// Splits groups as described for `keep_manifold` of `weld`: first groups of points with equal
/// coordinates, then groups of the results, so that a group that must be split does not separate
/// its own faces. After `rounds` rounds, all groups of a component of the welded mesh that is still
/// not manifold are split into single points.
///
/// \pre  every corner is a valid point number; every point is in a group
/// \throws std::invalid_argument for more than 2^32 / 3 faces
/// \cost O(V + F log d) time a round for at most d edges at a point; one round if points were
///       manifold before and no face collapses
/// \same on any number of threads
[[nodiscard]] manifold_groups split_to_manifold(mesh_view mesh, const point_groups& given,
                                                int rounds = 32);

}  // namespace treeform::detail::weld
