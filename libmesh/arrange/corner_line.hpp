#pragma once
/// \file
/// A line along an axis through a face of an arrangement, however small the face is.

#include <libmesh/exact/implicit_point.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/aabb.hpp>

#include <array>

namespace treeform::detail::arrange {

/// The line along an axis through a + s (b - a) + s^2 (c - a), for the corners a, b, c of a face
/// and an infinitesimal s > 0: next to a corner, inside the face. It passes through triangles
/// strictly inside or not at all, even if no point with double coordinates is inside the face.
class corner_line {
  public:
    /// \pre the face is not seen edge on along the axis: `orient2d` of its corners is not 0
    corner_line(const std::array<implicit_point, 3>& corners, int along);

    [[nodiscard]] int along() const { return along_; }
    /// +1 if the normal of the face points along the axis, -1 if against it.
    [[nodiscard]] int faces() const { return faces_; }
    /// A box around corner a.
    [[nodiscard]] const aabb<double, 3>& start() const { return start_; }

    /// If the line passes through a triangle, the sign of the triangle's normal along the axis;
    /// else 0.
    [[nodiscard]] int passes(const triangle3& t) const;

    /// The side of the face on which the line meets the plane of a triangle: +1 further along the
    /// axis, -1 before, 0 if both planes are equal.
    ///
    /// \param facing the sign of the triangle's normal along the axis, not 0
    [[nodiscard]] int place(const triangle3& t, int facing) const;

  private:
    template <class Point>
    [[nodiscard]] int passes(const std::array<Point, 3>& t,
                             const std::array<Point, 3>& corners) const;

    std::array<implicit_point, 3> corners_;
    triangle3 given_{};      ///< the corners
    bool is_given_ = false;  ///< whether all corners are given points
    int along_;
    int faces_;
    aabb<double, 3> start_{};
};

}  // namespace treeform::detail::arrange
