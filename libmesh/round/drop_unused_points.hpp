#pragma once
/// \file
/// Drops points that no face uses.

#include <libmesh/base/used_points.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::round {

/// Drops the points that no face uses. The others keep their order.
///
/// \param point_of  [V] is updated as well
/// \cost O(V + F)
inline void drop_unused_points(mesh& surface, std::vector<std::uint32_t>& point_of) {
    const std::vector<std::uint32_t> used = base::used_points(surface.points.size(), surface.faces);
    std::vector<std::uint32_t> new_of_old(surface.points.size());
    for (std::uint32_t p = 0; p < used.size(); ++p) {
        surface.points[p] = surface.points[used[p]];
        point_of[p] = point_of[used[p]];
        new_of_old[used[p]] = p;
    }
    surface.points.resize(used.size());
    point_of.resize(used.size());
    for (face& f : surface.faces)
        for (std::uint32_t& corner : f) corner = new_of_old[corner];
}

}  // namespace treeform::detail::round
