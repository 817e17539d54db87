#pragma once
/// \file
/// What sources of this room share: what of the inputs is carried to what is made of them, and
/// where in a face a point is.

#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace treeform::detail::carry {

/// The source of each face and vertex of the result, as in `boolean_result`.
struct carried_elements {
    std::span<const operand_element> face_source;           ///< [F]
    std::span<const operand_element> vertex_source;         ///< [V]
    std::span<const operand_element> face_of_cut_vertex{};  ///< [V] or empty
    /// [3 F], for a single input, as in `simplify_result`; or empty
    std::span<const std::uint32_t> corner_source{};
};

/// Sets the corner values of `file` from those of the inputs.
///
/// A corner of a face with a source gets the value of the source face at its position: the value of
/// a corner of the source face if it is at that corner, otherwise an interpolated value (for
/// normals, an interpolated direction). Normals of flipped faces are negated. A corner gets no
/// value if the face has no source, or if the source face has no value at a corner with a nonzero
/// weight.
///
/// Each used row of an input is stored once in the result, in the order of first use, so that
/// corners that shared a row still do. Faces from the same input face share an interpolated value
/// at a common point. With `corner_source`, values are those of these corners, or interpolated in
/// the face of a new vertex; a face whose source has a single normal gets its own normal. Texture
/// coordinates that a PLY file had as double are written as double to PLY.
void carry_corners(mesh_file& file, std::span<const attribute_source> inputs,
                   const carried_elements& made);

/// Whether two triangles with a common edge have equal values at both of its ends; for normals, it
/// suffices that each triangle has a single one. `at_ends` has the corners of both triangles at
/// each end.
[[nodiscard]] bool look_alike(const corner_values& corners,
                              const std::array<std::uint32_t, 2>& triangles,
                              const std::array<std::array<std::size_t, 2>, 2>& at_ends);

/// The material of face `face` of an input; empty if it has none.
[[nodiscard]] const std::string& material_of(const attribute_source& input, std::uint32_t face);

/// Sets the parts of `file`, with the materials of the source faces, and the material files of all
/// inputs. With a single input, parts also keep their names; with several, names would only tell
/// the origin of each piece. A face without a source is put into the part of a face with a common
/// corner. Texture files are those of the first input: with several inputs, `unite_textures` must
/// have made one list before.
void carry_materials(mesh_file& file, std::span<const attribute_source> inputs,
                     const carried_elements& made);

struct shares_of_corners {
    std::array<double, 3> of{1.0, 0.0, 0.0};  ///< barycentric coordinates; their sum is 1
    double outside = 0.0;  ///< sum of the magnitudes of negative coordinates that were set to 0
};

/// The barycentric coordinates of `p` in a triangle: exactly 1 for a corner if `p` equals it, and 1
/// for the first corner if the triangle has no area.
[[nodiscard]] shares_of_corners shares_at(const point3& p, const point3& a, const point3& b,
                                          const point3& c);

/// The parameter of `p` along the segment from `a` to `b`, in [0, 1]; 0 if `a` equals `b`.
[[nodiscard]] double share_along(const point3& p, const point3& a, const point3& b);

/// Twice the area long.
[[nodiscard]] point3 normal_of(const mesh& mesh, const face& f);

/// Whether two normals point in opposite directions (negative dot product).
[[nodiscard]] bool is_turned(const point3& normal, const point3& other);

/// `v` as a unit vector; zero if `v` is zero.
[[nodiscard]] point3 with_length_one(const point3& v);

/// A property by its name, and where each input has it.
struct property {
    std::string name;
    scalar_type type;
    std::vector<const column*> of_input;  ///< null where it has none
};

/// The properties of an element that have one value a row, except for the normals of points.
[[nodiscard]] std::vector<property> properties_of(std::span<const attribute_source> inputs,
                                                  const char* name);

/// The header of the first file, if it is LAS; otherwise empty. Scale and offset are changed so
/// that they can represent the points of all files, as far as the bounds in the headers tell. It
/// describes the extra bytes of all files.
///
/// \throws std::invalid_argument for files with different coordinate systems or types of GPS time,
///         unless `mixed`
[[nodiscard]] std::optional<las_header> join_las(std::span<const mesh_file> files,
                                                 std::span<const std::string> names, bool mixed);

/// A part with its own points.
struct solid_part {
    std::string name{};
    treeform::mesh mesh{};
    std::vector<std::uint32_t> faces{};   ///< [F] face numbers in the file, ascending
    std::vector<std::uint32_t> points{};  ///< [V] point numbers in the file, ascending
};

/// The parts of a file, as of `file_parts`, with their points; empty where there is but one.
[[nodiscard]] std::vector<solid_part> solid_parts(const attribute_source& input);

}  // namespace treeform::detail::carry
