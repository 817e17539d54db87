#pragma once
/// \file
/// The bodies of a file made ready for queries, and what has become of them put back.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/export.hpp>
#include <treeform/tree/transform.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace treeform {

/// A file's mesh, or a part of it, or a cloud.
struct file_body {
    std::string name{};  ///< of the part; empty where the file has no other
    /// [F] The triangle in the file's mesh, or the point of a cloud, of each face; empty: the same.
    std::vector<std::uint32_t> triangle_of_face{};

    [[nodiscard]] std::uint32_t triangle(std::uint32_t f) const {
        return triangle_of_face.empty() ? f : triangle_of_face[f];
    }
    /// The number in the file.
    [[nodiscard]] std::uint32_t stored_face(const mesh_file& file, std::uint32_t f) const {
        const std::uint32_t t = triangle(f);
        return file.stored_face.empty() ? t : file.stored_face[t];
    }
};

struct file_bodies {
    std::vector<file_body> bodies{};  ///< [B]; none when there is nothing to compute with
    /// [B] Faces are finite triangles of the file; equal corners are one point, and only points
    /// that faces use are there. Those of a cloud are its finite points.
    std::vector<prepared_mesh> shapes{};
    bool cloud = false;        ///< the file has no faces
    std::size_t left_out = 0;  ///< its triangles, or points, with a coordinate that is not finite
};

/// All of `file` as one body.
///
/// \cost   O(V + F)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API file_bodies whole_body(const mesh_file& file);

/// The parts of `file` as `scene_parts` has them, each a body; the whole where it has one.
[[nodiscard]] TREEFORM_API file_bodies bodies_of(const mesh_file& file);

/// Gives the points of `file` that `body` stands for the places of `placed`, which is by the points
/// of `shape`; all other points are moved by `matrix`, and rounded to float32 if asked for.
TREEFORM_API void put_back(mesh_file& file, const file_body& body, const prepared_mesh& shape,
                           points_view placed, const transform<3>& matrix, precision written_as);

/// Rounds every point of the file to float32; how far a coordinate has moved at most.
TREEFORM_API double round_to_float32(mesh_file& file);

}  // namespace treeform
