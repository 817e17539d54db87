#pragma once
/// \file
/// What must hold of a solid's surface, looked at from outside the code that made it.

#include <libmesh/intersect/point_location.hpp>
#include <libmesh/intersect/self_intersections.hpp>
#include <libmesh/mesh.hpp>
#include <libmesh/validate.hpp>
#include <libmesh/weld/equal_points.hpp>

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
