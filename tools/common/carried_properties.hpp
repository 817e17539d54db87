#pragma once
/// \file
/// Properties of the inputs' points and faces, for the points and faces of what is made of them.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace tools {

/// An input whose elements are named by `operand_element`: points as in the file, faces as in
/// `file->mesh`, which `triangle_of_face` takes back to the triangles of the file.
struct property_source {
    const tf::mesh_file* file = nullptr;
    const std::vector<std::uint32_t>* triangle_of_face = nullptr;  ///< empty: the same

    /// The triangle of the file.
    [[nodiscard]] std::uint32_t triangle(std::uint32_t face) const {
        return triangle_of_face->empty() ? face : (*triangle_of_face)[face];
    }
    /// The number in the file.
    [[nodiscard]] std::uint32_t stored_face(std::uint32_t face) const {
        const std::uint32_t t = triangle(face);
        return file->stored_face.empty() ? t : file->stored_face[t];
    }
};

/// What the elements of a mesh come from.
struct carried_to {
    std::span<const tf::operand_element> face_source;           ///< [F]
    std::span<const tf::operand_element> vertex_source;         ///< [V]
    std::span<const tf::operand_element> face_of_cut_vertex{};  ///< [V] or empty
};

/// Gives `file` the columns that elements "vertex" and "face" of the inputs have with one value a
/// row, by name.
///
/// A face has the values of its source, which it lies in, a point those of its own; a point that
/// was cut has values between those of the corners of the face it lies in:
/// `made.face_of_cut_vertex` or else the lowest of its faces' sources. Where an input has no such
/// column, or a face no source, 0 or NaN stands.
///
/// Normals of points (columns nx, ny and nz) are turned around where the surface is, and have
/// length 1 again at points that were cut, where there are several the one of the lowest face;
/// where an input has none, that of the face stands.
///
/// What corners have, and materials, is carried as `carry_corners` and `carry_materials` say.
void carry_properties(tf::mesh_file& file, std::span<const property_source> inputs,
                      const carried_to& made);

/// [faces of all inputs, one input after the other] Numbers that are equal for faces with equal
/// values in all columns that are carried and of one material, if `by_values`, and of one input, if
/// `by_input`. With `by_values`, a face whose corners differ in texture coordinates or normals is
/// like no other: what lies between them is told by the face alone. Empty when that tells no faces
/// apart.
[[nodiscard]] std::vector<std::uint32_t> groups_of_faces(std::span<const property_source> inputs,
                                                         bool by_values, bool by_input);

/// Whether points of an input have values that `carry_properties` carries.
[[nodiscard]] bool points_have_properties(std::span<const property_source> inputs);

/// Whether an input has values that `carry_properties` leaves out.
[[nodiscard]] bool leaves_out_properties(std::span<const property_source> inputs);

}  // namespace tools
