#pragma once
/// \file
/// Equal points, and faces whose corners with equal coordinates are one.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/weld.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::weld {

/// Replaces, in `group_of_point`, the first point of the group of each point by the number of the
/// group. Groups are numbered in the order of their first points, which are returned, ascending.
[[nodiscard]] std::vector<std::uint32_t> number_groups(std::vector<std::uint32_t>& group_of_point);

/// [V] For each point, the lowest-numbered point with the same coordinates (-0 equals +0) and
/// label. A point with a NaN coordinate equals only itself. `label` is [V] or empty.
///
/// \cost as `find_equal_points`
[[nodiscard]] std::vector<std::uint32_t> equal_firsts(points_view points,
                                                      std::span<const std::uint32_t> label);

/// The groups of `find_equal_points`; empty if all points differ.
///
/// Only points whose hash has a mark in common with another point are compared: about a tenth of
/// the different ones.
///
/// \throws std::invalid_argument for more than 2^32 - 1 points
/// \cost   as `find_equal_points` for a tenth of the points, and 4 bytes a point
/// \same   on any number of threads
[[nodiscard]] std::optional<point_groups> few_equal_points(points_view points);

/// The faces of a mesh, with each corner replaced by the lowest vertex with equal coordinates.
struct joined_faces {
    bool changed = false;     ///< false: no two vertices are equal
    std::vector<face> faces;  ///< [F]; empty if not changed

    /// `mesh` with these faces. \pre they were computed for `mesh`
    [[nodiscard]] mesh_view of(mesh_view mesh) const {
        return {mesh.points, changed ? std::span<const face>(faces) : mesh.faces};
    }
};

/// \pre    every corner is a vertex
/// \throws std::invalid_argument for more than 2^32 - 1 vertices
/// \cost   as `few_equal_points`, and O(F) if some are equal
/// \same   on any number of threads
[[nodiscard]] joined_faces join_faces(mesh_view mesh);

/// The same, cached in the prepared mesh.
[[nodiscard]] const joined_faces& join_faces(const prepared_mesh& mesh);

}  // namespace treeform::detail::weld
