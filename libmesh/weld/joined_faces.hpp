#pragma once
/// \file
/// Faces in which vertices with equal coordinates are joined.

#include <treeform/mesh/mesh.hpp>

#include <vector>

namespace treeform::detail::weld {

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
