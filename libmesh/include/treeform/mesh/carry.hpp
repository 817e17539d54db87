#pragma once
/// \file
/// Attributes of input meshes, for the mesh that an operation has made of them.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/transform.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace treeform {

/// An input as an operation has numbered it: vertices as in the file, faces as in `file->mesh`.
struct carry_source {
    const mesh_file* file = nullptr;
    /// [F] the triangle of the file that each face of `file->mesh` is; empty: the same.
    std::span<const std::uint32_t> triangle_of_face{};

    /// The triangle of the file.
    [[nodiscard]] std::uint32_t triangle(std::uint32_t f) const {
        return triangle_of_face.empty() ? f : triangle_of_face[f];
    }
    /// The number in the file.
    [[nodiscard]] std::uint32_t stored_face(std::uint32_t f) const {
        const std::uint32_t t = triangle(f);
        return file->stored_face.empty() ? t : file->stored_face[t];
    }
};

/// What the elements of the result come from, as in `boolean_result`.
struct carried_elements {
    std::span<const operand_element> face_source;           ///< [F]
    std::span<const operand_element> vertex_source;         ///< [V]
    std::span<const operand_element> face_of_cut_vertex{};  ///< [V] or empty
};

/// Gives `file`, whose mesh was made of the inputs, their attributes: columns of vertices and faces
/// with one value a row, texture coordinates and normals of corners, materials and the files of
/// materials and textures.
///
/// A face has the values of its source, which it lies in, a vertex those of its own. A vertex that
/// was cut has values between those of the corners of the face it lies in (`face_of_cut_vertex`, or
/// else the lowest of its faces' sources), and so have corners. Where an input has no such column,
/// or a face no source, 0 or NaN stands. Normals are turned around where the surface is, and have
/// length 1 again where vertices were cut. Lists and other elements are not carried.
///
/// \pre  sources are in range
/// \cost O(V + F) for each column
TREEFORM_API void carry(mesh_file& file, std::span<const carry_source> inputs,
                        const carried_elements& made);

/// The same of one input, for what has been made of it alone, as `resolve_result` says: a number
/// that is `operand_element::none` is of no face or vertex.
TREEFORM_API void carry(mesh_file& file, const carry_source& input,
                        std::span<const std::uint32_t> face_source,
                        std::span<const std::uint32_t> vertex_source);

/// [faces of all inputs, one input after the other] Numbers that are equal for faces with equal
/// values in all columns that are carried and of one material, if `by_values`, and of one input, if
/// `by_input`; for `boolean_options::face_groups`. With `by_values`, a face whose corners differ in
/// texture coordinates or normals is like no other: what lies between them is told by the face
/// alone. Empty when that tells no faces apart.
[[nodiscard]] TREEFORM_API std::vector<std::uint32_t> face_groups(
    std::span<const carry_source> inputs, bool by_values, bool by_input);

/// Whether vertices of an input have values that `carry` carries.
[[nodiscard]] TREEFORM_API bool has_vertex_values(std::span<const carry_source> inputs);

/// Whether an input has values that `carry` leaves out.
[[nodiscard]] TREEFORM_API bool has_values_left_out(std::span<const carry_source> inputs);

/// Names of materials, ascending, that inputs with different material files have in common: an OBJ
/// made of them has one of a name.
[[nodiscard]] TREEFORM_API std::vector<std::string> ambiguous_materials(
    std::span<const mesh_file* const> inputs);

/// The property "texnumber" of faces, a number in `texture_files` each; null where there is none.
[[nodiscard]] TREEFORM_API const column* texture_numbers(const mesh_file& file);

/// Gives all `files` one list of texture files, that of the first with the names that further ones
/// add, and their faces int32 numbers in it. `names` stand for the files in what is warned of.
///
/// Faces of a file without numbers have that of its first name. Those that named none have -1, as
/// all of a file without names; numbers other than -1 that name none are warned of. Faces are given
/// no numbers where one name is all there is and no file has numbers, or texture coordinates
/// without a name. A single file stays as it is, and so do files without names.
[[nodiscard]] TREEFORM_API std::vector<io_warning> unite_textures(
    std::span<mesh_file* const> files, std::span<const std::string> names);

/// Turns the columns nx, ny, nz of the file's elements, and the normals of corners, as `by` turns
/// normals; their lengths stay.
TREEFORM_API void transform_normals(mesh_file& file, const transform<3>& by);

}  // namespace treeform
