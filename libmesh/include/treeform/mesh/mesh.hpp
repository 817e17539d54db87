#pragma once
/// \file
/// Triangle meshes: points and triples of their numbers.

#include <treeform/mesh/points.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform {

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

/// Which corners of faces are one vertex, where it matters: whether a mesh is closed, and which of
/// its faces hang together.
enum class vertex_identity : std::uint8_t {
    by_coordinates,  ///< equal coordinates: right also for files that repeat them, as STL does
    by_index         ///< the same number
};

struct mesh {
    std::vector<point3> points;  ///< [V]
    std::vector<face> faces;     ///< [F]

    operator mesh_view() const { return {points, faces}; }  // NOLINT: meant to be implicit
    friend bool operator==(const mesh&, const mesh&) = default;
};

}  // namespace treeform
