#pragma once
/// \file
/// Faces whose corners with equal coordinates are one.

#include <treeform/mesh/mesh.hpp>

#include <vector>

namespace treeform::detail::weld {

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
