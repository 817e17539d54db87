#pragma once
/// \file
/// Between which of many parallel planes points lie, exactly.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/section.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::cut {

/// Parallel planes in their order, and where points are among them.
struct plane_levels {
    point3 normal{};
    std::vector<point3>
        planes{};  ///< [K] a point of each, ascending along the normal, no two equal
    std::vector<std::uint32_t> rank{};  ///< [given planes] which of `planes` each is
    /// [V] how many planes are below a point or at it; 0 for points that are not finite.
    std::vector<std::uint32_t> level{};
    std::vector<std::uint8_t> on{};  ///< [V] 1 where it lies in the plane `level` - 1

    /// Whether the point lies in plane k. \pre it is not below plane k
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

/// The faces that each plane meets.
struct met_faces {
    std::vector<std::size_t> begin;
    std::vector<std::uint32_t> faces;  ///< plane by plane, ascending

    [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t k) const {
        return std::span(faces).subspan(begin[k], begin[k + 1] - begin[k]);
    }
};

/// Of faces with three different corners, those with corners below and above a plane.
/// \cost O(F), and what is returned
[[nodiscard]] met_faces faces_met(mesh_view mesh, const plane_levels& levels, std::size_t planes);

}  // namespace treeform::detail::cut
