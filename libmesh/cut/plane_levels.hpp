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

}  // namespace treeform::detail::cut
