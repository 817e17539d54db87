#pragma once
/// \file
/// Positions of two meshes in C.

#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <tools/c/glue.hpp>

#include <algorithm>

namespace glue {

/// [count] of matrices one after the other; null: the mesh stays where it is.
[[nodiscard]] inline std::vector<tf::mesh_positions> positions(const double* moves_a,
                                                               const double* moves_b,
                                                               std::size_t count) {
    std::vector<tf::mesh_positions> result(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (moves_a) result[i].move_a = matrix(moves_a + 12 * i);
        if (moves_b) result[i].move_b = matrix(moves_b + 12 * i);
    }
    return result;
}

}  // namespace glue
