#pragma once
/// \file
/// Quadric error metric: the positions that change a surface least.

#include <libmesh/base/point_math.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace treeform::detail::simplify {

/// Sum of squared distances from planes, weighted by area: symmetric, 4 x 4.
struct quadric {
    std::array<double, 10> of{};

    void add(const quadric& other) {
        for (std::size_t i = 0; i < of.size(); ++i) of[i] += other.of[i];
    }
    void add_plane(const point3& n, double d, double weight) {
        const std::array<double, 4> v{n.x, n.y, n.z, d};
        for (std::size_t i = 0, k = 0; i < 4; ++i)
            for (std::size_t j = i; j < 4; ++j) of[k++] += weight * v[i] * v[j];
    }
    [[nodiscard]] double at(const point3& p) const {
        return p.x * (of[0] * p.x + 2 * (of[1] * p.y + of[2] * p.z + of[3])) +
               p.y * (of[4] * p.y + 2 * (of[5] * p.z + of[6])) + p.z * (of[7] * p.z + 2 * of[8]) +
               of[9];
    }
    /// The position of the minimum; not finite if it is not unique.
    [[nodiscard]] point3 lowest() const {
        const point3 a{of[0], of[1], of[2]}, b{of[1], of[4], of[5]}, c{of[2], of[5], of[7]};
        const point3 bc = base::cross(b, c), ca = base::cross(c, a), ab = base::cross(a, b);
        const double all = base::dot(a, bc), trace = of[0] + of[4] + of[7];
        if (!(all > 1e-6 * trace * trace * trace)) return {std::nan(""), 0.0, 0.0};
        return base::scaled(
            base::plus(base::scaled(bc, of[3]),
                       base::plus(base::scaled(ca, of[6]), base::scaled(ab, of[8]))),
            -1.0 / all);
    }
};

}  // namespace treeform::detail::simplify
