#pragma once
/// \file
/// Arithmetic of points and vectors in double. Each operation is rounded once, and sums go from
/// left to right; error bounds elsewhere rely on that.

#include <treeform/mesh/mesh.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace treeform::detail::base {

[[nodiscard]] inline bool is_finite(const point3& p) {
    // Differences, not a sum of all: a sum may overflow.
    return p.x - p.x == 0.0 && p.y - p.y == 0.0 && p.z - p.z == 0.0;
}

[[nodiscard]] inline bool all_finite(const std::vector<point3>& points) {
    return std::all_of(points.begin(), points.end(), is_finite);
}

[[nodiscard]] inline point3 plus(const point3& a, const point3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[nodiscard]] inline point3 minus(const point3& a, const point3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] inline point3 scaled(const point3& v, double by) {
    return {v.x * by, v.y * by, v.z * by};
}
[[nodiscard]] inline double dot(const point3& a, const point3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[nodiscard]] inline point3 cross(const point3& a, const point3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The largest magnitude of a coordinate.
[[nodiscard]] inline double largest_of(const point3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

/// The corners of a face.
[[nodiscard]] inline std::array<point3, 3> triangle_of(points_view points, const face& f) {
    return {points[f[0]], points[f[1]], points[f[2]]};
}
[[nodiscard]] inline std::array<point3, 3> triangle_of(mesh_view mesh, std::uint32_t f) {
    return triangle_of(mesh.points, mesh.faces[f]);
}

}  // namespace treeform::detail::base
