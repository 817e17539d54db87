#pragma once
/// \file
/// Self-intersections by CGAL.

#include "bench/workload.hpp"
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <functional>
#include <optional>

namespace treeform::bench {

/// `PMP::self_intersections` with the kernel EPICK on a Surface_mesh that is given, sequential or,
/// for more than one thread, with its Parallel_tag. Meshes that half-edges cannot hold are
/// oriented and cut at their non-manifold edges and points first; then faces count as meeting
/// where they only shared a point before, so that no error is defined. Pairs of a degenerate face
/// are not looked for.
///
/// The error is the distance of the number of pairs from what `expected` returns.
[[nodiscard]] job cgal_self_intersections(const tf::mesh& mesh, unsigned threads,
                                          std::function<std::optional<double>()> expected);

/// The number of pairs the above finds; none where the mesh has to be cut for it.
[[nodiscard]] std::optional<double> cgal_pair_count(const tf::mesh& mesh);

}  // namespace treeform::bench
