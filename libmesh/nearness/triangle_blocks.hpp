#pragma once
/// \file
/// Triangles in the leaf order of a tree, in blocks of eight for SIMD.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/tree.hpp>

#include <array>
#include <cstddef>

namespace treeform::detail::nearness {

/// The triangles of a leaf block. Unused slots repeat the first triangle, so that bounds over all
/// slots are bounds of the triangles.
struct alignas(64) eight_triangles {
    double at[3][3][8];  ///< corner, axis, slot

    [[nodiscard]] triangle3 triangle(std::size_t slot) const {
        triangle3 t;
        for (std::size_t corner = 0; corner < 3; ++corner)
            for (std::size_t axis = 0; axis < 3; ++axis) t[corner][axis] = at[corner][axis][slot];
        return t;
    }
    void set(std::size_t slot, const triangle3& t) {
        for (std::size_t corner = 0; corner < 3; ++corner)
            for (std::size_t axis = 0; axis < 3; ++axis) at[corner][axis][slot] = t[corner][axis];
    }
};

/// [blocks] The faces of `mesh` in the leaf order of `tree`.
[[nodiscard]] TREEFORM_API buffer<eight_triangles> triangle_blocks(mesh_view mesh,
                                                                   const tree<3>& tree);

/// Sets `to` to `from` with every corner transformed by `by`, as by `transform::operator()`, and
/// then multiplied by `unit`. `to` may be `from`.
void move_triangles(const eight_triangles& from, const transform<3>& by, double unit,
                    eight_triangles& to);

/// A separating direction; the length of `direction` is 1 up to 2^-50.
struct sight_line {
    point3 origin;
    point3 direction;
};

/// Pairs of slots of two blocks: bit j of element i.
using slot_pairs = std::array<unsigned, 8>;

/// Removes from `pairs` the pairs that are farther apart than `distance` along the line, with b
/// ahead of a.
void drop_separated(const eight_triangles& a, const eight_triangles& b, const sight_line& line,
                    double distance, slot_pairs& pairs);

}  // namespace treeform::detail::nearness
