#pragma once
/// \file
/// The bounding box of coplanar points in projection along an axis, and a triangle around it.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace treeform::detail::arrange {

class planar_box {
  public:
    explicit planar_box(int axis)
        : x_(static_cast<std::size_t>((axis + 1) % 3)),
          y_(static_cast<std::size_t>((axis + 2) % 3)) {}

    /// Extends the box to contain everything within `reach` of `p`.
    void include(const point3& p, double reach = 0.0) {
        box_.include(std::array{p[x_] - reach, p[y_] - reach});
        box_.include(std::array{p[x_] + reach, p[y_] + reach});
    }

    /// A triangle that strictly contains the box in projection. It is counter-clockwise, seen
    /// against the axis times `orientation` (+1 or -1).
    ///
    /// With extents w and h of the box and u an ulp of its largest coordinate, d is the larger of w
    /// + h and 4 u. The legs, of length 6 d, begin d before the box, or at most 1.5 d with rounding
    /// (half an ulp, and one ulp for `nextafter`), and end at most d / 8 early. Seen from the right
    /// angle, coordinates in the box add up to at most w + h + 2 * 1.5 d, which is 4 d.
    ///
    /// \pre the box is not empty
    [[nodiscard]] std::array<point3, 3> triangle_around(int orientation) const {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        const double largest = std::max({std::abs(box_.min[0]), std::abs(box_.max[0]),
                                         std::abs(box_.min[1]), std::abs(box_.max[1])});
        const double d = std::max((box_.max[0] - box_.min[0]) + (box_.max[1] - box_.min[1]),
                                  4.0 * (std::nextafter(largest, infinity) - largest));
        const double left = std::nextafter(box_.min[0] - d, -infinity);
        const double bottom = std::nextafter(box_.min[1] - d, -infinity);
        std::array<point3, 3> result{};
        for (point3& p : result) {
            p[x_] = left;
            p[y_] = bottom;
        }
        result[1][x_] = left + 6.0 * d;
        result[2][y_] = bottom + 6.0 * d;
        if (orientation < 0) std::swap(result[1], result[2]);
        return result;
    }

  private:
    std::size_t x_, y_;  ///< axes of the projection
    aabb<double, 2> box_{};
};

}  // namespace treeform::detail::arrange
