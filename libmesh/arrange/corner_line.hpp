#pragma once
/// \file
/// A line along an axis through a face of an arrangement, however small the face is.

#include <libmesh/exact/implicit_point.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/aabb.hpp>

#include <array>

namespace treeform::detail::arrange {

/// The line along an axis through a + s (b - a) + s^2 (c - a), for the corners a, b, c of a face
/// and an s > 0 smaller than any number: right beside a corner, and inside the face. It passes
/// through triangles strictly inside or not at all. There need not be a point of doubles inside the
/// face.
class corner_line {
  public:
    /// \pre the face is not seen edge on along the axis: `orient2d` of its corners is not 0
    corner_line(const std::array<implicit_point, 3>& corners, int along);

    [[nodiscard]] int along() const { return along_; }
    /// Which way the normal of the face points: along the axis, +1, or against it.
    [[nodiscard]] int faces() const { return faces_; }
    /// Around corner a.
    [[nodiscard]] const aabb<double, 3>& start() const { return start_; }

    /// The sign of the normal of a triangle along the axis where the line passes through it, else
    /// 0.
    [[nodiscard]] int passes(const triangle3& t) const;

    /// Where the line meets the plane of a triangle: +1 ahead of the face, -1 behind it, 0 where
    /// both are one plane.
    ///
    /// \param facing which way the normal of the triangle points along the axis, not 0
    [[nodiscard]] int place(const triangle3& t, int facing) const;

  private:
    template <class Point>
    [[nodiscard]] int passes(const std::array<Point, 3>& t,
                             const std::array<Point, 3>& corners) const;

    std::array<implicit_point, 3> corners_;
    triangle3 given_{};      ///< the corners
    bool is_given_ = false;  ///< all of them are in `given_`
    int along_;
    int faces_;
    aabb<double, 3> start_{};
};

}  // namespace treeform::detail::arrange
