#pragma once
/// \file
/// Bounding cylinders of tree nodes. Unlike axis-aligned boxes, they are thin wherever the surface
/// is nearly flat, in any orientation.

#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/nearness/triangle_blocks.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/detail/frame_map.hpp>
#include <treeform/tree/detail/near_pair_walk.hpp>
#include <treeform/tree/tree.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace treeform::detail::nearness {

/// The cylinders of the children of a node, in the frame of the tree. A cylinder is the set of
/// points center + s n + v with |s| <= half, v perpendicular to n, and |v| <= radius, where n is
/// `normal` normalized; the length of `normal` is 1 up to 2^-22. An infinite radius means no bound.
struct alignas(64) eight_cylinders {
    float center[3][8];
    float normal[3][8];
    float half[8];
    float radius[8];
};

/// The cylinders around the triangles of every node except the root; about 5 bytes a triangle.
class TREEFORM_API bounding_cylinders {
  public:
    bounding_cylinders() = default;
    /// \cost O(F) time
    bounding_cylinders(const tree<3>& tree, const buffer<eight_triangles>& triangles);

    /// The cylinders of the children of a node. \pre the children are nodes, not leaf blocks
    [[nodiscard]] const eight_cylinders& below(std::uint32_t level, std::uint32_t node) const {
        return cylinders_[begin_[level] + node];
    }

  private:
    std::array<std::size_t, 12> begin_{};
    buffer<eight_cylinders> cylinders_;
};

/// The cylinders of two trees, and their maps into the common frame of a search.
struct cylinder_pair {
    const bounding_cylinders& a;
    const bounding_cylinders& b;
    const frame_map<3>& map_a;
    const frame_map<3>& map_b;

    /// Implements `raise_bounds`.
    [[nodiscard]] unsigned raise(const opened_node& at, unsigned mask, float bound,
                                 float* squared) const;
};

/// Takes about 80 bytes a face, and about half the build time of a tree.
struct face_blocks {
    buffer<eight_triangles> triangles;
    bounding_cylinders cylinders;
};

/// The blocks of the tree `build_face_tree(mesh)`, cached in the mesh.
[[nodiscard]] const face_blocks& face_blocks_of(const prepared_mesh& mesh);

}  // namespace treeform::detail::nearness
