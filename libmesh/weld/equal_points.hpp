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

/// `group_of_point` comes in as the first point of each point's group, and leaves as the number of
/// the group; groups are numbered by their first points, which are returned, ascending.
[[nodiscard]] std::vector<std::uint32_t> number_groups(std::vector<std::uint32_t>& group_of_point);

/// [V] The lowest-numbered point with the coordinates (-0 equals +0) and the label of each; a point
/// with a NaN coordinate equals nothing. `label` is [V] or empty.
///
/// \cost as `find_equal_points`
[[nodiscard]] std::vector<std::uint32_t> equal_firsts(points_view points,
                                                      std::span<const std::uint32_t> label);

/// As `find_equal_points`; none where all points differ.
///
/// Only points that share the mark of their hash with another are compared, a tenth of those that
/// differ.
///
/// \throws std::invalid_argument for more than 2^32 - 1 points
/// \cost   as `find_equal_points` of a tenth of the points, and 4 bytes a point
/// \same   on any number of threads
[[nodiscard]] std::optional<point_groups> few_equal_points(points_view points);

/// The faces of a mesh with each corner replaced by the lowest vertex of equal coordinates.
struct joined_faces {
    bool changed = false;     ///< otherwise no two vertices are equal
    std::vector<face> faces;  ///< [F], or empty where nothing has changed

    /// `mesh` with these faces. \pre these are of `mesh`
    [[nodiscard]] mesh_view of(mesh_view mesh) const {
        return {mesh.points, changed ? std::span<const face>(faces) : mesh.faces};
    }
};

/// \pre    every corner is a vertex
/// \throws std::invalid_argument for more than 2^32 - 1 vertices
/// \cost   as `few_equal_points`, and O(F) where some are equal
/// \same   on any number of threads
[[nodiscard]] joined_faces join_faces(mesh_view mesh);

/// The same of a prepared mesh, which keeps them.
[[nodiscard]] const joined_faces& join_faces(const prepared_mesh& mesh);

}  // namespace treeform::detail::weld
