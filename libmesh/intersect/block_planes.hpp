#pragma once
/// \file
/// Tests the triangles of a leaf block against the planes of those of another.

#include <libmesh/nearness/triangle_blocks.hpp>
#include <treeform/mesh/mesh.hpp>

namespace treeform::detail::intersect {

/// Triangles relative to an origin near them, and their planes; one triangle in each slot.
struct alignas(64) block_planes {
    double at[3][3][8];   ///< [corner][axis][slot] minus the origin
    double normal[3][8];  ///< normal, of length twice the area
    double offset[8];     ///< dot product of the normal and a point of the plane
    double spread[8];     ///< sum of the magnitudes of all products in the normal
    double reach;         ///< sum of the magnitudes of all coordinates, or NaN
};

/// Converts `from` relative to `origin`, and computes the planes.
void find_planes(const nearness::eight_triangles& from, const point3& origin, block_planes& to);

/// Removes from `pairs` those in which one triangle certainly lies strictly on one side of the
/// other's plane. Both blocks must have the same origin.
void drop_beyond_planes(const block_planes& a, const block_planes& b, nearness::slot_pairs& pairs);

}  // namespace treeform::detail::intersect
