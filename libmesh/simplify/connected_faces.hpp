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
