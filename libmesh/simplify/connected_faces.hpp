#pragma once
/// \file
/// Connectivity of faces.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace treeform::detail::simplify {

using ids = std::vector<std::uint32_t>;
inline constexpr std::uint32_t no_face = std::numeric_limits<std::uint32_t>::max();

/// The index (0, 1 or 2) of the vertex in the face.
[[nodiscard]] inline std::uint32_t corner_of(const face& f, std::uint32_t p) {
    return f[0] == p ? 0 : f[1] == p ? 1 : 2;
}

/// The mesh to be simplified: equal points are joined, and all faces have three different corners.
struct connected_faces {
    std::vector<point3> points;
    std::vector<face> faces;
    ids source;             ///< [F] face number in the input
    std::vector<ids> star;  ///< [V] faces at each vertex, ascending
    /// [F] The neighbor across the side from corner i to the next; `no_face` unless there is
    /// exactly one, consistently oriented.
    std::vector<std::array<std::uint32_t, 3>> mates;

    connected_faces(mesh_view given, precision of_points);
};

}  // namespace treeform::detail::simplify
