#pragma once
/// \file
/// Faces by their vertices.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace treeform::detail::simplify {

using ids = std::vector<std::uint32_t>;
inline constexpr std::uint32_t no_face = std::numeric_limits<std::uint32_t>::max();

/// Where in the face the vertex is.
[[nodiscard]] inline std::uint32_t corner_of(const face& f, std::uint32_t p) {
    return f[0] == p ? 0 : f[1] == p ? 1 : 2;
}

/// What is simplified: equal points are one, faces have three different corners.
struct connected_faces {
    std::vector<point3> points;
    std::vector<face> faces;
    ids source;             ///< [F] of each face, its number in the input
    std::vector<ids> star;  ///< [V] faces, ascending
    /// [F] across the side from corner i to the next; `no_face` where there is not one that goes
    /// on.
    std::vector<std::array<std::uint32_t, 3>> mates;

    connected_faces(mesh_view given, precision of_points);
};

}  // namespace treeform::detail::simplify
