#pragma once
/// \file
/// Points, triangle meshes, the views of them that algorithms take, and the box around them.

#include <treeform/tree/detail/export.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform {

/// A point or vector of the plane.
struct point2 {
    double x = 0.0;
    double y = 0.0;

    [[nodiscard]] constexpr double operator[](std::size_t axis) const { return axis == 0 ? x : y; }
    [[nodiscard]] constexpr double& operator[](std::size_t axis) { return axis == 0 ? x : y; }
    friend constexpr bool operator==(const point2&, const point2&) = default;
};

/// A point or vector of space. Equality is that of doubles: -0 equals +0.
struct point3 {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;

    [[nodiscard]] constexpr double operator[](std::size_t axis) const {
        return axis == 0 ? x : axis == 1 ? y : z;
    }
    [[nodiscard]] constexpr double& operator[](std::size_t axis) {
        return axis == 0 ? x : axis == 1 ? y : z;
    }
    friend constexpr bool operator==(const point3&, const point3&) = default;
};

using points_view = std::span<const point3>;  ///< [V]

/// The corners of a triangle as numbers of points; counter-clockwise seen from outside.
using face = std::array<std::uint32_t, 3>;

/// What algorithms take: somebody else's arrays. Every corner is less than `points.size()`.
struct mesh_view {
    std::span<const point3> points;  ///< [V]
    std::span<const face> faces;     ///< [F]
};

/// The numbers that coordinates are written as.
enum class precision : std::uint8_t {
    float32,  ///< as a binary STL holds them
    float64   ///< doubles
};

/// Which corners of faces are the same vertex. This decides whether a mesh is closed, and which of
/// its faces are neighbors.
enum class vertex_identity : std::uint8_t {
    by_coordinates,  ///< those with equal coordinates: also right for files that repeat them (STL)
    by_index         ///< those with the same number
};

/// A triangle mesh that owns its arrays. Every corner is less than `points.size()`.
struct mesh {
    std::vector<point3> points;  ///< [V]
    std::vector<face> faces;     ///< [F]

    operator mesh_view() const { return {points, faces}; }  // NOLINT: meant to be implicit
    friend bool operator==(const mesh&, const mesh&) = default;
};

/// A closed axis-aligned box.
struct box3 {
    point3 min;
    point3 max;

    /// Length of the diagonal, rounded. Where it would be infinite, the largest double.
    [[nodiscard]] TREEFORM_API double diagonal() const;

    friend bool operator==(const box3&, const box3&) = default;
};

/// The smallest box around all finite points; none when there is no such point.
///
/// \cost O(V) time
/// \same on any number of threads
[[nodiscard]] TREEFORM_API std::optional<box3> bounding_box(points_view points);

}  // namespace treeform
