#pragma once
/// \file
/// The triangles of a leaf block against the planes of those of another.

#include <libmesh/nearness/triangle_blocks.hpp>
#include <treeform/mesh/mesh.hpp>

namespace treeform::detail::intersect {

/// Triangles about an origin near them, and their planes, a triangle a slot.
struct alignas(64) block_planes {
    double at[3][3][8];   ///< corner, axis, slot: less the origin
    double normal[3][8];  ///< as long as twice the area
    double offset[8];     ///< the product of the normal with a point of the plane
    double spread[8];     ///< the sum of the magnitudes of all products that make up the normal
    double reach;         ///< the sum of the magnitudes of all coordinates, or NaN
};

/// `from` about `origin`, and its planes.
void find_planes(const nearness::eight_triangles& from, const point3& origin, block_planes& to);

/// Takes from `pairs` those of which one triangle lies strictly on one side of the other's plane,
/// as far as that is certain. Both blocks are about one origin.
void drop_beyond_planes(const block_planes& a, const block_planes& b, nearness::slot_pairs& pairs);

}  // namespace treeform::detail::intersect
