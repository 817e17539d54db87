#pragma once
/// \file
/// Exact classification of points by parallel planes.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/section.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::cut {

/// Parallel planes in ascending order, and the positions of points relative to them.
struct plane_levels {
    point3 normal{};
    std::vector<point3>
        planes{};  ///< [K] one point of each plane; ascending along the normal, without duplicates
    std::vector<std::uint32_t> rank{};  ///< [given planes] index of each in `planes`
    /// [V] number of planes below or through each point; 0 for points that are not finite.
    std::vector<std::uint32_t> level{};
    std::vector<std::uint8_t> on{};  ///< [V] 1 if the point is in plane `level` - 1

    /// Whether the point is in plane k. \pre it is not below plane k
    [[nodiscard]] bool is_on(std::uint32_t point, std::uint32_t k) const {
        return on[point] != 0 && level[point] == k + 1;
    }
};

/// \throws std::invalid_argument naming `function` for a plane or height that is not finite, or a
///         normal that is zero
/// \cost   O(K log K + V log K)
/// \same   on any number of threads
[[nodiscard]] plane_levels levels_of(const char* function, points_view points,
                                     const oriented_plane& plane, std::span<const double> heights);

/// The faces that each plane intersects.
struct met_faces {
    std::vector<std::size_t> begin;
    std::vector<std::uint32_t> faces;  ///< plane by plane; ascending within a plane

    [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t k) const {
        return std::span(faces).subspan(begin[k], begin[k + 1] - begin[k]);
    }
};

/// The faces, with three different corners, that have corners both below and above a plane.
/// \cost O(F + size of the result)
[[nodiscard]] met_faces faces_met(mesh_view mesh, const plane_levels& levels, std::size_t planes);

}  // namespace treeform::detail::cut
