#pragma once
/// \file
/// The union of many solids by CGAL.

#include "bench/workload.hpp"
#include <treeform/mesh/mesh.hpp>

#include <vector>

namespace treeform::bench {

/// `PMP::corefine_and_compute_union` of two solids, then of two of the results, and so on, in the
/// kernel EPICK: predicates are exact, constructed points rounded. What it takes apart as it goes
/// is copied first, in the time. The error is 1 where a step fails.
[[nodiscard]] job cgal_unions(const std::vector<mesh>& solids);

}  // namespace treeform::bench
