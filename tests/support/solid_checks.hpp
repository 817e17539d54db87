#pragma once
/// \file
/// What must hold of a solid's surface, looked at from outside the code that made it.

#include <treeform/mesh/equal_points.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/validate.hpp>
#include <treeform/tf.hpp>

#include <cstddef>

namespace test {

/// Closed, and no two faces have more in common than corners and edges.
inline bool is_clean_solid(const tf::mesh& mesh) {
    if (tf::find_defects(mesh) != tf::mesh_defects{}) return false;
    if (tf::find_equal_points(mesh.points).first_of_new.size() != mesh.points.size()) return false;
    if (tf::find_open_edge(mesh)) return false;
    return tf::self_intersections(mesh).pairs.empty();
}

}  // namespace test
