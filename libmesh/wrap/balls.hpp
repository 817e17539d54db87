#pragma once
/// \file
/// Spheres through the corners of tetrahedra and faces, in rounded arithmetic.

#include <libmesh/base/point_math.hpp>
#include <treeform/mesh/mesh.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace treeform::detail::wrap {

struct ball {
    point3 center;
    double squared_radius = 0.0;
};

/// The circumscribed ball; empty if the points are so nearly coplanar that its center is not
/// finite.
[[nodiscard]] inline std::optional<ball> ball_of(const std::array<point3, 4>& corners) {
    using namespace base;
    const point3 b = minus(corners[1], corners[0]);
    const point3 c = minus(corners[2], corners[0]);
    const point3 d = minus(corners[3], corners[0]);
    const point3 cd = cross(c, d);
    const double volume = 2.0 * dot(b, cd);
    const point3 sum = plus(plus(scaled(cd, dot(b, b)), scaled(cross(d, b), dot(c, c))),
                            scaled(cross(b, c), dot(d, d)));
    const point3 arm = scaled(sum, 1.0 / volume);
    const ball result{plus(corners[0], arm), dot(arm, arm)};
    if (!is_finite(result.center) || !std::isfinite(result.squared_radius)) return std::nullopt;
    return result;
}

/// The smallest ball whose sphere passes through the three corners of a face.
[[nodiscard]] inline std::optional<ball> ball_of(const std::array<point3, 3>& corners) {
    using namespace base;
    const point3 b = minus(corners[1], corners[0]);
    const point3 c = minus(corners[2], corners[0]);
    const point3 normal = cross(b, c);
    const point3 sum =
        plus(scaled(cross(c, normal), dot(b, b)), scaled(cross(normal, b), dot(c, c)));
    const point3 arm = scaled(sum, 1.0 / (2.0 * dot(normal, normal)));
    const ball result{plus(corners[0], arm), dot(arm, arm)};
    if (!is_finite(result.center) || !std::isfinite(result.squared_radius)) return std::nullopt;
    return result;
}

/// The squared least radius of the balls whose spheres pass through the corners of a face, with
/// centers between those of `outer` and `inner`: that of an empty ball, with no corner of a
/// tetrahedron inside, at the face.
[[nodiscard]] inline double least_squared_radius(const std::array<point3, 3>& face,
                                                 const std::optional<ball>& outer,
                                                 const std::optional<ball>& inner) {
    using namespace base;
    const std::optional<ball> own = ball_of(face);
    if (!own) return std::numeric_limits<double>::infinity();
    const point3 normal = cross(minus(face[1], face[0]), minus(face[2], face[0]));
    const auto height = [&](const std::optional<ball>& of) {
        return of ? dot(normal, minus(of->center, face[0])) : 0.0;
    };
    const bool on_one_side = height(outer) * height(inner) > 0.0;
    return on_one_side ? std::min(outer->squared_radius, inner->squared_radius)
                       : own->squared_radius;
}

}  // namespace treeform::detail::wrap
