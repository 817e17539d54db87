#pragma once
/// \file
/// Classifies points as inside or outside of a closed surface.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::place {

struct point_sides {
    std::vector<std::int8_t> side{};    ///< [Q] -1 inside, 0 on the surface, 1 outside
    std::uint64_t winding_numbers = 0;  ///< number of winding numbers counted along a whole ray
};

/// The side of each query, as by `locate`; queries are in a spatial order, which makes it cheap. A
/// point has the winding number of the previous point if no face lies between them; otherwise the
/// crossed faces are counted. `locate` decides the rest.
///
/// \pre  `mesh` is closed and `tree` is its face tree; queries are finite; `distance[i]` is the
///       distance of `queries[i]` from the surface, at most `error` above the true one
/// \same on any number of threads
[[nodiscard]] point_sides sides_in_order(mesh_view mesh, const tree<3>& tree,
                                         std::span<const point3> queries,
                                         std::span<const double> distance, double error);

/// [Q] The side of each query, given in any order: -1 inside, 0 on the surface, 1 outside.
///
/// \pre  `mesh` is closed and `tree` is its face tree; queries are finite
/// \same   on any number of threads
[[nodiscard]] std::vector<std::int8_t> sides_of(mesh_view mesh, const tree<3>& tree,
                                                std::span<const point3> queries);

}  // namespace treeform::detail::place
