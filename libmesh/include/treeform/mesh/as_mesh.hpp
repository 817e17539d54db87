#pragma once
/// \file
/// Converts files to meshes for all operations: drops unusable faces, joins equal points, joins
/// several files.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace treeform {

/// A mesh without NaN or infinite coordinates, and the file's number of each face.
struct usable_mesh {
    treeform::mesh mesh{};
    /// [F] the triangle in the file of each face; empty: the same numbers.
    std::vector<std::uint32_t> triangle_of_face{};
    /// [triangles] the face in the file of each triangle; empty: the same numbers.
    std::vector<std::uint32_t> stored_face{};
    std::uint64_t non_finite = 0;  ///< triangles with a coordinate that is not finite
    /// From `usable_part`: [F] the connected component of the whole mesh that each face is in.
    std::vector<std::uint32_t> component{};
    std::uint64_t degenerate = 0;             ///< likewise: triangles that are a segment or a point
    std::optional<std::uint64_t> distinct{};  ///< likewise: different points, where they are known
    std::uint64_t joined = 0;                 ///< likewise: points merged by tolerance

    /// The triangle of the file.
    [[nodiscard]] std::uint32_t triangle(std::uint32_t f) const {
        return triangle_of_face.empty() ? f : triangle_of_face[f];
    }
    /// The number in the file.
    [[nodiscard]] std::uint32_t face_in_file(std::uint32_t f) const {
        const std::uint32_t t = triangle(f);
        return stored_face.empty() ? t : stored_face[t];
    }
    operator mesh_view() const { return mesh; }  // NOLINT: meant to be implicit
};

/// The mesh of `file`. Triangles with a NaN or infinite coordinate are dropped. Corners with equal
/// coordinates become one vertex. Vertices keep the numbers of the file; of equal vertices, faces
/// use the lowest. Coordinates that are not finite become 0; no face uses them.
///
/// \throws std::invalid_argument naming a face with a corner out of range
/// \cost   O(V + F)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API usable_mesh as_mesh(mesh_file file);

/// The mesh of a file: `as_mesh(read(path))`.
[[nodiscard]] TREEFORM_API usable_mesh read_mesh(const std::filesystem::path& path);

/// Which part of a mesh.
struct part_options {
    /// Whether points with equal coordinates are one vertex.
    vertex_identity vertices = vertex_identity::by_coordinates;
    /// If greater than 0, points within this distance are joined, as by `weld`, after equal points.
    double tolerance = 0.0;
    std::optional<box3> box{};  ///< only faces that meet it
    bool details = false;       ///< also compute `component` and `distinct`
};

/// The usable part of a file's mesh: its finite faces; with a box, only those that meet the box.
/// The result has the number of each face in the file. Points that only dropped faces use are
/// dropped, too.
///
/// `stored_face` is the file's.
///
/// \throws std::invalid_argument as `faces_in_box`, `weld`
/// \cost   O(V + F); with a tolerance, as `group_points`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API usable_mesh usable_part(mesh given,
                                                   std::vector<std::uint32_t> stored_face,
                                                   const part_options& options = {});

/// Drops the faces of `mesh` with a corner that is not finite or out of range. Returns [F] the
/// previous number of each kept face; empty if all are kept.
TREEFORM_API std::vector<std::uint32_t> drop_unusable_faces(mesh& mesh);

/// One file with the points and faces of all `files`, one after the other, in the format of the
/// first.
///
/// Columns of "vertex" and "face" are matched by name. If a file lacks a column, its rows get NaN,
/// 0 or empty lists. Types are widened until they hold every value. Corners keep their texture
/// coordinates, normals and texture files. Other elements are dropped (warning "left-out"). `names`
/// has one name for each file, for the warnings.
///
/// Columns of points that formats call by different names get that of the first file's format
/// (`normal_x` of PCD, `nx` of PLY). The header of LAS is that of the first file. Where scales or
/// offsets differ, it gets the finest of the scales that holds the points of all, as their headers
/// say where these are; extra bytes are described as in the first file that has them. LAS files of
/// different reference systems, or whose GPS time is counted in different ways, are joined only if
/// `mixed`: what the first one says of it is written.
///
/// \throws std::invalid_argument for such LAS files unless `mixed`, when a column holds
///         lists in one file and single values in another, when no type holds all values, or when
///         there is not one name for each file; std::length_error for more points or triangles than
///         32 bits can number
/// \cost   O(size of all files)
[[nodiscard]] TREEFORM_API mesh_file join(std::vector<mesh_file> files,
                                          std::span<const std::string> names, bool mixed = false);

/// All files in one, with their parts, texture coordinates, normals, materials and textures. Other
/// properties are left out. `warnings` says what could not be kept of textures. The format, and the
/// type of its numbers, are those of the first. `names` are those of the faces of files that have a
/// single part; `labels` are for warnings.
///
/// \pre  there is a file, and as many names and labels as files
/// \cost O(size of all files)
[[nodiscard]] TREEFORM_API mesh_file scene_of(std::span<const mesh_file* const> files,
                                              std::span<const std::string> names,
                                              std::span<const std::string> labels);

/// The faces of all `meshes`, one mesh after the other. A point that is not finite becomes 0.
///
/// \pre    no face has a corner that is not finite
/// \throws std::invalid_argument as `join_equal_points`
/// \cost   O(V + F)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API mesh join_meshes(std::span<const mesh_view> meshes);

}  // namespace treeform
