#pragma once
/// \file
/// Where in a face a point is, and how faces look.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <array>

namespace tools {

struct shares_of_corners {
    std::array<double, 3> of{1.0, 0.0, 0.0};  ///< sums up to 1
    double outside = 0.0;  ///< what was left out as it was negative, on the same scale
};

/// How much of each corner of a triangle there is in a point of it: exactly 1 of a corner where it
/// is that one, and of the first where the triangle has no area.
[[nodiscard]] shares_of_corners shares_at(const tf::point3& p, const tf::point3& a,
                                          const tf::point3& b, const tf::point3& c);

/// How far along from `a` to `b` a point is, from 0 to 1; 0 where they are equal.
[[nodiscard]] double share_along(const tf::point3& p, const tf::point3& a, const tf::point3& b);

/// Twice the area long.
[[nodiscard]] tf::point3 normal_of(const tf::mesh& mesh, const tf::face& f);

/// Whether two normals look away from each other.
[[nodiscard]] bool is_turned(const tf::point3& normal, const tf::point3& other);

/// `v` itself where it is zero.
[[nodiscard]] tf::point3 with_length_one(const tf::point3& v);

}  // namespace tools
