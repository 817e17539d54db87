#pragma once
/// \file
/// A triangle in a frame on its longest edge, precomputed for distances from many points.

#include <libmesh/base/point_math.hpp>
#include <treeform/mesh/predicates.hpp>

#include <cstddef>

namespace treeform::detail::geometry {

/// The points of the triangle are corner + s base + t height with 0 <= t <= 1 and t apex <= s <= 1
/// - t (1 - apex): `height` is perpendicular to `base`, from its foot at `apex` to the third
/// corner; `apex` is in [0, 1] because the base is the longest edge.
///
/// Unlike barycentric coordinates, which divide by the normal, the distance along the base is
/// correct up to a rounding of the lengths for any aspect ratio. An error in the direction of
/// `height`, which is large only if `height` is short, moves no point of the triangle by more than
/// a few roundings of the base.
struct based_triangle {
    point3 corner;
    point3 base;
    point3 height;
    double apex = 0.0;
    double per_base = 0.0;    ///< 1 / base^2; 0 for a base of length 0
    double per_height = 0.0;  ///< 1 / height^2; 0 for a height of length 0

    based_triangle() = default;
    explicit based_triangle(const triangle3& t) {
        std::size_t longest = 0;
        double square = -1.0;
        for (std::size_t i = 0; i < 3; ++i) {
            const point3 edge = base::minus(t[(i + 1) % 3], t[i]);
            if (!(base::dot(edge, edge) > square)) continue;
            square = base::dot(edge, edge);
            longest = i;
            base = edge;
        }
        corner = t[longest];
        per_base = square > 0.0 ? 1.0 / square : 0.0;
        const point3 side = base::minus(t[(longest + 2) % 3], corner);
        apex = base::dot(side, base) * per_base;
        apex = apex < 0.0 ? 0.0 : apex > 1.0 ? 1.0 : apex;
        for (std::size_t k = 0; k < 3; ++k) height[k] = side[k] - apex * base[k];
        const double height_square = base::dot(height, height);
        per_height = height_square > 0.0 ? 1.0 / height_square : 0.0;
    }

    [[nodiscard]] point3 at(double s, double t) const {
        point3 p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = corner[k] + (s * base[k] + t * height[k]);
        return p;
    }
};

}  // namespace treeform::detail::geometry
