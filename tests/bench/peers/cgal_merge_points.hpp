#pragma once
/// \file
/// Equal points of a polygon soup joined by CGAL.

#include "bench/workload.hpp"
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <cstddef>

namespace treeform::bench {

/// `PMP::merge_duplicate_points_in_polygon_soup` on a soup of the kernel EPICK's points, which it
/// changes in place; the copy it is given of it is not timed. The error is how many more or fewer
/// points than `distinct` it leaves.
[[nodiscard]] job cgal_merge_points(const tf::mesh& mesh, std::size_t distinct);

}  // namespace treeform::bench
