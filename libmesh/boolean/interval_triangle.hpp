#pragma once
/// \file
/// Triangles and segments whose corners are intervals, and a test whether they certainly miss a
/// box.

#include <libmesh/base/point_math.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace treeform::detail::boolean {

/// A triangle or a segment whose corners have an error of at most `off_` along each axis.
class interval_triangle {
  public:
    /// With corners anywhere in these boxes.
    explicit interval_triangle(std::span<const aabb<double, 3>> corners) : count_(corners.size()) {
        for (std::size_t i = 0; i < count_; ++i) {
            all_.include(corners[i]);
            for (std::size_t k = 0; k < 3; ++k) {
                at_[i][k] = 0.5 * corners[i].min[k] + 0.5 * corners[i].max[k];
                off_ = std::max(off_, corners[i].max[k] - corners[i].min[k]);
            }
        }
        find_axes();
    }
    /// A triangle with exact corners.
    explicit interval_triangle(const std::array<point3, 3>& corners) : count_(3), at_(corners) {
        for (const point3& corner : corners) all_.include(corner);
        find_axes();
    }

    [[nodiscard]] const aabb<double, 3>& box() const { return all_; }

    /// Whether the triangle or segment certainly misses a box. A separating axis test with the
    /// normal, and the cross products of edges with the axes of the box (Akenine-Moeller, Fast 3D
    /// Triangle-Box Overlap Testing, 2001), on which both ends of the edge have the same
    /// projection.
    ///
    /// Errors, for the largest coordinate M, relative to the sum of the coordinates of the axis:
    /// differences from the middle 2^-52 M, three roundings of products and of their sum 2^-50.4 M,
    /// the two ends of a rounded edge 2^-51 M, and the reach 2^-51 M; together less than 2^-48 M.
    /// Products that underflow are off by less than 2^-1000, and those of three numbers below 2^330
    /// do not overflow.
    [[nodiscard]] bool is_apart_from(const aabb<double, 3>& box) const {
        point3 middle, reach;
        double largest = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            middle[k] = 0.5 * box.min[k] + 0.5 * box.max[k];
            reach[k] = 0.5 * box.max[k] - 0.5 * box.min[k];
            largest =
                std::max({largest, std::abs(middle[k]) + reach[k], -all_.min[k], all_.max[k]});
        }
        if (!(largest < 0x1p330)) return false;
        const double off = off_ + 0x1p-48 * largest;
        for (std::size_t k = 0; k < 3; ++k) reach[k] += off;
        std::array<point3, 3> p;
        for (std::size_t i = 0; i < count_; ++i) p[i] = base::minus(at_[i], middle);
        if (count_ == 2) return is_apart_beside(edges_[0], p[0], p[0], reach);
        const double far = reach_along(normal_, reach);
        const double a = base::dot(normal_, p[0]), b = base::dot(normal_, p[1]),
                     c = base::dot(normal_, p[2]);
        if (std::min({a, b, c}) > far || std::max({a, b, c}) < -far) return true;
        return is_apart_beside(edges_[0], p[0], p[2], reach) ||
               is_apart_beside(edges_[1], p[1], p[0], reach) ||
               is_apart_beside(edges_[2], p[2], p[1], reach);
    }

  private:
    void find_axes() {
        edges_[0] = base::minus(at_[1], at_[0]);
        if (count_ == 2) return;
        edges_[1] = base::minus(at_[2], at_[1]);
        edges_[2] = base::minus(at_[0], at_[2]);
        normal_ = base::cross(edges_[0], base::minus(at_[2], at_[0]));
    }
    static double reach_along(const point3& axis, const point3& reach) {
        return std::abs(axis.x) * reach.x + std::abs(axis.y) * reach.y +
               std::abs(axis.z) * reach.z + 0x1p-1000;
    }
    /// Tests the axes normal to the edge at corner `p`; `q` is the corner that is not on the edge.
    static bool is_apart_beside(const point3& edge, const point3& p, const point3& q,
                                const point3& reach) {
        bool is_apart = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
            const double a = edge[l] * p[m] - edge[m] * p[l];
            const double b = edge[l] * q[m] - edge[m] * q[l];
            const double far =
                std::abs(edge[l]) * reach[m] + std::abs(edge[m]) * reach[l] + 0x1p-1000;
            is_apart = is_apart || std::min(a, b) > far || std::max(a, b) < -far;
        }
        return is_apart;
    }

    std::size_t count_;
    std::array<point3, 3> at_{};
    std::array<point3, 3> edges_{};  ///< from each corner to the next
    point3 normal_{};
    double off_ = 0.0;
    aabb<double, 3> all_{};
};

}  // namespace treeform::detail::boolean
