#pragma once
/// \file
/// Points with equal coordinates become one point.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/export.hpp>

#include <cstdint>
#include <vector>

namespace treeform {

struct equal_points {
    std::vector<std::uint32_t> new_of_old;    ///< [V] the distinct point that each point is
    std::vector<std::uint32_t> first_of_new;  ///< [U] lowest-numbered point of each, ascending
};

/// Finds the points whose coordinates are equal as doubles (-0 equals +0).
///
/// Distinct points are numbered in the order of their first appearance. Infinities equal
/// themselves; points with a NaN coordinate equal nothing, not even themselves. However close
/// they are, points that differ in one bit (other than that of -0) stay distinct.
///
/// \throws std::invalid_argument for more than 2^32 - 1 points
/// \cost   O(V) expected time, also when all points are equal; about 12 bytes a point besides the
///         result's `first_of_new`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API equal_points find_equal_points(points_view points);

/// `mesh` with equal points joined: points in order of first appearance, each at the coordinates
/// of its first bit for bit; faces in order, also those that now repeat a corner. Nothing is
/// dropped, not even points that no face uses.
///
/// \throws std::invalid_argument for more than 2^32 - 1 points, or naming the lowest face with a
///         corner that is no point
/// \cost   as `find_equal_points`, and O(F)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API mesh join_equal_points(mesh_view mesh);

}  // namespace treeform
