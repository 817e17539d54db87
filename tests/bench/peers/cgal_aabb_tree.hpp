#pragma once
/// \file
/// The AABB tree of CGAL.

#include "bench/workload.hpp"
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

namespace treeform::bench {

/// Builds AABB_tree (simple Cartesian doubles, triangle primitives) over a vector of triangles,
/// which is given.
[[nodiscard]] job cgal_aabb_tree(const tf::mesh& mesh);

}  // namespace treeform::bench
