#pragma once
/// \file
/// Converts files to meshes for the operations: drops unusable faces, joins equal points,
/// concatenates files.

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
    /// [F] the number of each face among the triangles of the file; empty: the same numbers.
    std::vector<std::uint32_t> triangle_of_face{};
    /// [triangles of the file] the face of the file that each triangle is a part of; empty: the
    /// same numbers.
    std::vector<std::uint32_t> face_of_triangle{};
    /// Number of triangles with a coordinate that is not finite; for a cloud, number of such
    /// points.
    std::uint64_t non_finite = 0;
    /// From `usable_faces`: [F] the connected component of the whole mesh that each face is in.
    std::vector<std::uint32_t> component{};
    std::uint64_t degenerate = 0;  ///< from `usable_faces`: triangles that are a segment or a point
    /// from `usable_faces` with `details`: number of different points
    std::optional<std::uint64_t> distinct{};
    std::uint64_t joined = 0;            ///< from `usable_faces`: points merged by tolerance
    std::vector<io_warning> warnings{};  ///< from `as_mesh`: those of the file

    /// The number of face `f` among the triangles of the file.
    [[nodiscard]] std::uint32_t triangle(std::uint32_t f) const {
        return triangle_of_face.empty() ? f : triangle_of_face[f];
    }
    /// The number of face `f` in the file.
    [[nodiscard]] std::uint32_t face_in_file(std::uint32_t f) const {
        const std::uint32_t t = triangle(f);
        return face_of_triangle.empty() ? t : face_of_triangle[t];
    }
    operator mesh_view() const { return mesh; }  // NOLINT: meant to be implicit
};

/// The mesh of `file`. Triangles with a NaN or infinite coordinate are dropped. Corners with equal
/// coordinates become one vertex. Vertices keep the numbers of the file; of equal vertices, faces
/// use the lowest. Points that are not finite become copies of the first finite one; no face uses
/// them. Of a point cloud, points that are not finite are dropped; `usable_mesh::non_finite` is
/// their number.
///
/// \throws std::invalid_argument naming a face with a corner out of range
/// \cost   O(V + F)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API usable_mesh as_mesh(mesh_file file);

/// The mesh of a file: `as_mesh(read(path))`.
[[nodiscard]] TREEFORM_API usable_mesh read_mesh(const std::filesystem::path& path);

/// Options of `usable_faces`.
struct usable_options {
    /// Whether points with equal coordinates are one vertex.
    vertex_identity vertices = vertex_identity::by_coordinates;
    /// If greater than 0, points within this distance are joined, as by `weld`, after equal points.
    double tolerance = 0.0;
    std::optional<box3> box{};  ///< only faces that have a point in the box
    bool details = false;       ///< also compute `component`, and count different points
};

/// The usable part of a file's mesh: its finite faces; with a box, only those that meet the box.
/// The result has the number of each face in the file. Points that only dropped faces use are
/// dropped as well.
///
/// `face_of_triangle` is `mesh_file::face_of_triangle` of the file.
///
/// \throws std::invalid_argument as `faces_in_box`, `weld`
/// \cost   O(V + F); with a tolerance, as `group_points`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API usable_mesh usable_faces(mesh given,
                                                    std::vector<std::uint32_t> face_of_triangle,
                                                    const usable_options& options = {});

/// Drops the faces of `mesh` with a corner that is not finite or out of range. Returns the previous
/// number of each kept face [F]; empty if all are kept.
TREEFORM_API std::vector<std::uint32_t> drop_unusable_faces(mesh& mesh);

/// Concatenates files: all points and faces of `files`, one file after the other, in the format of
/// the first.
///
/// Columns of "vertex" and "face" are matched by name. If a file lacks a column, its rows get NaN,
/// 0 or empty lists. Types are widened until they hold every value. Corners keep their texture
/// coordinates, normals and texture files. Other elements are dropped (warning "data-dropped").
/// `names` has one name for each file, for the warnings.
///
/// Columns of points whose names depend on the format (`normal_x` in PCD, `nx` in PLY) get the
/// names of the first file's format. The LAS header is copied from the first file. If scales or
/// offsets differ, it gets the finest of the files' scales with which 32 bits can represent the
/// bounds of all headers; extra bytes are described as in the first file that has them. LAS files
/// with different coordinate systems or different types of GPS time are joined only with `mixed`;
/// the result then has the coordinate system and type of the first file.
///
/// \throws std::invalid_argument for such LAS files unless `mixed`, if a column holds lists in one
///         file and single values in another, if no type holds all values, or unless there is one
///         name for each file; std::length_error for more points or triangles than 32 bits can
///         number
/// \cost   O(size of all files)
[[nodiscard]] TREEFORM_API mesh_file concatenate_files(std::vector<mesh_file> files,
                                                       std::span<const std::string> names,
                                                       bool mixed = false);

/// One file with all `files` as parts of a scene, with texture coordinates, normals, materials and
/// textures. Other properties are omitted. `warnings` lists textures that could not be kept.
/// `format` and `stored_as` are copied from the first file. `names` has one name for each file. The
/// only part of a file gets this name, and so do faces before the first part of any file. `labels`
/// has the name of each file in warnings.
///
/// \pre  there is at least one file, and one name and one label for each file
/// \cost O(size of all files)
[[nodiscard]] TREEFORM_API mesh_file scene_of(std::span<const mesh_file* const> files,
                                              std::span<const std::string> names,
                                              std::span<const std::string> labels);

/// The faces of all `meshes`, one mesh after the other, with equal points joined (unlike
/// `concatenate`). A point that is not finite becomes 0; in a cloud, it is dropped.
///
/// \pre    no face has a corner that is not finite
/// \throws std::invalid_argument as `join_equal_points`
/// \cost   O(V + F)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API mesh join_meshes(std::span<const mesh_view> meshes);

}  // namespace treeform
