#pragma once
/// \file
/// Faces without area, and faces that lie on others.

#include <libmesh/repair/working_mesh.hpp>

#include <cstdint>

namespace treeform::detail::repair {

/// Drops faces with collinear corners; returns how many. Exact.
std::uint64_t drop_degenerate(working_mesh& mesh);

/// The same; where there are any, drops those with them that are thinner than a step of float32
/// numbers: they came about as the others did, but were rounded the other way. Where these are far
/// more, they did not, and stay.
std::uint64_t drop_degenerate_and_slivers(working_mesh& mesh);

/// Drops faces with the same corners as another one; returns how many.
///
/// Of parts every face of which has a copy, as has a sheet with a back or a model that is there
/// twice, one copy stays. Elsewhere a copy goes where that makes faces run as often one way as the
/// other along each of its edges, or more nearly so; and copies of linked faces go together where
/// that leaves fewer edges with an odd number of faces. Two cubes face to face keep their common
/// square, which the arrangement cancels out.
std::uint64_t drop_copies(working_mesh& mesh);

}  // namespace treeform::detail::repair
