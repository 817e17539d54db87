#pragma once
/// \file
/// On which side of a closed surface points are that are given in an order of space.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::place {

struct point_sides {
    std::vector<std::int8_t> side{};    ///< [Q] -1 inside, 0 on the surface, 1 outside
    std::uint64_t winding_numbers = 0;  ///< that were counted along a whole ray
};

/// The side of each query, as `locate` tells, which decides where nothing cheaper does: the winding
/// number of a point is that of the one before it when no face lies between them, and where faces
/// do, they are counted.
///
/// \pre  `mesh` is closed and `tree` that of its faces; queries are finite, `distance[i]` is that
///       of `queries[i]` from the surface, no more than `error` above the true one
/// \same on any number of threads
[[nodiscard]] point_sides sides_in_order(mesh_view mesh, const tree<3>& tree,
                                         std::span<const point3> queries,
                                         std::span<const double> distance, double error);

/// [Q] The side of each query, given in any order: -1 inside, 0 on the surface, 1 outside.
///
/// \pre  `mesh` is closed and `tree` that of its faces; queries are finite
/// \same   on any number of threads
[[nodiscard]] std::vector<std::int8_t> sides_of(mesh_view mesh, const tree<3>& tree,
                                                std::span<const point3> queries);

}  // namespace treeform::detail::place
