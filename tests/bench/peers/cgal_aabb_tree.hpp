#pragma once
/// \file
/// The AABB tree of CGAL.

#include "bench/workload.hpp"
#include <libmesh/mesh.hpp>

namespace tf::bench {

/// Builds AABB_tree (simple Cartesian doubles, triangle primitives) over a vector of triangles,
/// which is given.
[[nodiscard]] job cgal_aabb_tree(const tf::mesh& mesh);

}  // namespace tf::bench
