#pragma once
/// \file
/// Drops degenerate and repeated faces.

#include <libmesh/repair/working_mesh.hpp>

#include <cstdint>

namespace treeform::detail::repair {

/// Drops faces with collinear corners; returns their number. Exact.
std::uint64_t drop_degenerate(working_mesh& mesh);

/// The same. If there are any, also drops faces thinner than a step of float32, which probably have
/// the same origin, but were rounded differently. If these are far more, they are kept.
std::uint64_t drop_degenerate_and_slivers(working_mesh& mesh);

/// Drops faces with the same corners as another face; returns their number.
///
/// Of parts of which every face has a copy, such as a sheet with a back, or a repeated model, one
/// copy is kept. Elsewhere a copy is dropped if that balances each of its edges, or reduces their
/// imbalance; copies of linked faces are dropped together if that leaves fewer edges with an odd
/// number of faces. Two cubes face to face keep both copies of their common square, which cancel
/// out in the arrangement.
std::uint64_t drop_copies(working_mesh& mesh);

}  // namespace treeform::detail::repair
