#pragma once
/// \file
/// Triangles and segments whose corners are known roughly, and boxes that they certainly miss.

#include <libmesh/base/point_math.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace treeform::detail::boolean {

/// A triangle or a segment, whose corners are off by no more than `off` along each axis.
class rough_corners {
  public:
    explicit rough_corners(std::span<const aabb<double, 3>> corners) : corners_(corners) {
        for (const aabb<double, 3>& corner : corners) all_.include(corner);
    }

    [[nodiscard]] const aabb<double, 3>& box() const { return all_; }

    /// Whether it is certain that a box has no point of them. Any axis may tell them apart; where
    /// projections to it are rounded, each of three products and two sums is off by 2^-53 of itself,
    /// and the difference from the middle by 2^-52 of the larger coordinate.
    [[nodiscard]] bool is_apart_from(const aabb<double, 3>& box) {
        if (axes_ == 0) find_axes();
        point3 middle, half;
        double largest = largest_;
        for (std::size_t k = 0; k < 3; ++k) {
            middle[k] = 0.5 * box.min[k] + 0.5 * box.max[k];
            half[k] = 0.5 * box.max[k] - 0.5 * box.min[k];
            largest = std::max({largest, std::abs(box.min[k]), std::abs(box.max[k])});
        }
        const double off = off_ + 0x1p-48 * largest;
        for (std::size_t a = 0; a < axes_; ++a) {
            const point3& axis = axis_[a];
            const point3 size = {std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)};
            const double reach = base::dot(size, half) + off * (size.x + size.y + size.z);
            bool is_above = true, is_below = true;
            for (std::size_t i = 0; i < corners_.size(); ++i) {
                const double at = base::dot(axis, base::minus(at_[i], middle));
                is_above = is_above && at > reach;
                is_below = is_below && at < -reach;
            }
            if (is_above || is_below) return true;
        }
        return false;
    }

  private:
    void find_axes() {
        const std::size_t count = corners_.size();
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                at_[i][k] = 0.5 * corners_[i].min[k] + 0.5 * corners_[i].max[k];
                off_ = std::max(off_, corners_[i].max[k] - corners_[i].min[k]);
                largest_ = std::max({largest_, std::abs(all_.min[k]), std::abs(all_.max[k])});
            }
        if (count == 3)
            add_axis(base::cross(base::minus(at_[1], at_[0]), base::minus(at_[2], at_[0])));
        for (std::size_t i = 0; i < count; ++i) {
            const point3 edge = base::minus(at_[(i + 1) % count], at_[i]);
            add_axis({0.0, -edge.z, edge.y});
            add_axis({edge.z, 0.0, -edge.x});
            add_axis({-edge.y, edge.x, 0.0});
        }
    }
    void add_axis(const point3& axis) { axis_[axes_++] = axis; }

    std::span<const aabb<double, 3>> corners_;
    aabb<double, 3> all_{};
    // Found where boxes do not do.
    std::array<point3, 3> at_{};
    double off_ = 0.0;
    double largest_ = 0.0;
    std::array<point3, 10> axis_{};
    std::size_t axes_ = 0;
};

}  // namespace treeform::detail::boolean
