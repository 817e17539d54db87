#pragma once
/// \file
/// The mesh of a file, ready for every operation.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tree/export.hpp>

#include <cstdint>
#include <vector>

namespace treeform {

/// A mesh whose faces are finite, with the way back to the file.
struct usable_mesh {
    treeform::mesh mesh{};
    /// [F] triangle of the file that each face is; empty: the same number.
    std::vector<std::uint32_t> triangle_of_face{};
    /// [triangles] face of the file that each triangle is of; empty: the same number.
    std::vector<std::uint32_t> stored_face{};
    std::uint64_t dropped = 0;  ///< triangles with a coordinate that is not finite

    /// The number in the file.
    [[nodiscard]] std::uint32_t face_in_file(std::uint32_t f) const {
        const std::uint32_t t = triangle_of_face.empty() ? f : triangle_of_face[f];
        return stored_face.empty() ? t : stored_face[t];
    }
    operator mesh_view() const { return mesh; }  // NOLINT: meant to be implicit
};

/// The mesh of `file`: triangles with a NaN or infinite coordinate are left out, corners with equal
/// coordinates become one. Vertices keep the numbers of the file; of equal ones the lowest is used.
/// A coordinate that is not finite, which no face uses then, becomes 0.
///
/// \throws std::invalid_argument naming a face with a corner that is no vertex
/// \cost   O(V + F)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API usable_mesh as_mesh(mesh_file file);

/// Leaves out the faces of `mesh` with a corner that is not finite or no vertex. [F] the number
/// before of each face that stays; empty where all do.
TREEFORM_API std::vector<std::uint32_t> drop_unusable_faces(mesh& mesh);

}  // namespace treeform
