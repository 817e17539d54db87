#pragma once
/// \file
/// Set operations by CGAL.

#include "bench/workload.hpp"
#include <treeform/mesh/mesh.hpp>

namespace treeform::bench {

enum class corefinement { set_union, set_difference, set_intersection };

/// `PMP::corefine_and_compute_*` of surface meshes that are given, in the kernel EPICK: predicates
/// are exact, constructed points rounded. It changes its operands: copying them is part of the
/// time. The error is 1 where it reports failure.
[[nodiscard]] job cgal_corefinement(const mesh& a, const mesh& b, corefinement operation);

}  // namespace treeform::bench
