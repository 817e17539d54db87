#pragma once
/// \file
/// What must hold of a solid's surface, looked at from outside the code that made it.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <cstddef>

namespace test {

/// Closed, and no two faces have more in common than corners and edges, in the coordinates: parts
/// that touch may have vertices of their own there.
inline bool is_clean_solid(const tf::mesh& mesh) {
    if (tf::find_open_edge(mesh)) return false;
    const tf::mesh joined = tf::join_equal_points(mesh);
    if (tf::find_invalid_faces(joined) != tf::invalid_faces{}) return false;
    if (tf::find_open_edge(joined)) return false;
    return tf::self_intersections(mesh).pairs.empty();
}

}  // namespace test
