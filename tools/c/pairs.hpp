#pragma once
/// \file
/// Positions of two meshes in C.

#include <treeform/mesh/intersections.hpp>

#include <tools/c/handles.hpp>

#include <algorithm>

namespace glue {

/// `ask(a, b, positions)` for `count` positions, of matrices one after the other; null: the mesh
/// stays where it is. Its answers go to `out`.
template <class Ask, class T>
void in_positions(const treeform_mesh* a, const treeform_mesh* b, const double* moves_a,
                  const double* moves_b, std::size_t count, const Ask& ask, std::span<T> out,
                  double radius = infinity) {
    std::vector<tf::mesh_positions> where(count);
    for (std::size_t i = 0; i < count; ++i) {
        where[i].radius = radius;
        if (moves_a) where[i].move_a = matrix(moves_a + 12 * i);
        if (moves_b) where[i].move_b = matrix(moves_b + 12 * i);
    }
    const tf::mesh_ref x = ref_for_pieces(a, "a"), y = ref_for_pieces(b, "b");
    in_pieces(count, [&](std::size_t begin, std::size_t end) {
        const auto found = ask(x, y, std::span(where).subspan(begin, end - begin));
        std::copy(found.begin(), found.end(), out.data() + begin);
    });
}

}  // namespace glue
