#pragma once
/// \file
/// Points within a distance of an earlier one become that one.

#include <libmesh/mesh.hpp>
#include <libtree/export.hpp>

#include <cstdint>
#include <vector>

namespace tf {

struct joined_points {
    std::vector<std::uint32_t> new_of_old;    ///< [V] the kept point that each point becomes
    std::vector<std::uint32_t> first_of_new;  ///< [U] the points that were kept, ascending
};

/// Joins points by the rule `first`: in their order, a point is dropped when an earlier kept one
/// lies within `distance` of it (Euclidean, inclusive), and then becomes the nearest of these, the
/// earliest among equally near ones.
///
/// So no two kept points are within `distance`, no point moves further than `distance`, and
/// joining again changes nothing. Every comparison is exact on the coordinates as given. Distance
/// 0 joins equal coordinates only (-0 equals +0). Points with a NaN or infinite coordinate are
/// kept apart from everything, also from their like.
///
/// \throws std::invalid_argument for a distance that is negative or not finite, or for more than
///         2^32 - 1 points
/// \cost   O(V) expected time, about 50 bytes a point; more only where thousands of kept points
///         share a cell of a millionth of the box, that is, of data with a few far outliers
/// \same   on any number of threads; serial
[[nodiscard]] TREEFORM_API joined_points find_points_within(points_view points, double distance);

/// `mesh` with points joined by `find_points_within`: kept points in order and unmoved, faces in
/// order, also those that now repeat a corner. Nothing is dropped.
[[nodiscard]] TREEFORM_API mesh join_points_within(mesh_view mesh, double distance);

}  // namespace tf
