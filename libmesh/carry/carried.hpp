#pragma once
/// \file
/// What sources of this room share: what of the inputs is carried to what is made of them, and
/// where in a face a point is.

#include <libmesh/attributes/scene_parts.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/carry.hpp>
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
    /// [3 F] or empty: of a single input, as in `simplify_result`
    std::span<const std::uint32_t> corner_source{};
};

/// Gives `file` the values that corners of the inputs have.
///
/// A corner of a face that lies in an input's face has what that face has there: that of one of its
/// corners where it is at this corner, and else values in between, of normals in the direction in
/// between. Normals are turned around where the face is. Where the input's face has none at a
/// corner that counts, or a face no source, there is none.
///
/// Rows of an input stand once in the result, in the order of their first use, so that what shares
/// one still does. Faces from one face of an input share what lies between at a point that they
/// share. Of a surface with `corner_source`, values are those of these corners, or in between in
/// the face of a new vertex; a face whose source has one normal gets its own. Where a PLY had
/// texture coordinates as double, they are double in one that is written.
void carry_corners(mesh_file& file, std::span<const carry_source> inputs,
                   const carried_elements& made);

/// Whether two triangles that share an edge have equal values at both of its ends, or of normals,
/// each has one only. `at_ends` has their corners at either end.
[[nodiscard]] bool look_alike(const corner_values& corners,
                              const std::array<std::uint32_t, 2>& triangles,
                              const std::array<std::array<std::size_t, 2>, 2>& at_ends);

/// The material of face `face` of an input; empty where it has none.
[[nodiscard]] const std::string& material_of(const carry_source& input, std::uint32_t face);

/// Gives `file` parts with the materials of the faces' sources, and the material files of all
/// inputs. Of a single input, parts keep their names, too: of several, they would name what each
/// piece of a result was once. A face without a source is in the part of a face that it has a
/// corner with. The texture files are those of the first input: of several, `unite_textures` has
/// been asked for one list.
void carry_materials(mesh_file& file, std::span<const carry_source> inputs,
                     const carried_elements& made);

struct shares_of_corners {
    std::array<double, 3> of{1.0, 0.0, 0.0};  ///< sums up to 1
    double outside = 0.0;  ///< what was left out as it was negative, on the same scale
};

/// How much of each corner of a triangle there is in a point of it: exactly 1 of a corner where it
/// is that one, and of the first where the triangle has no area.
[[nodiscard]] shares_of_corners shares_at(const point3& p, const point3& a, const point3& b,
                                          const point3& c);

/// How far along from `a` to `b` a point is, from 0 to 1; 0 where they are equal.
[[nodiscard]] double share_along(const point3& p, const point3& a, const point3& b);

/// Twice the area long.
[[nodiscard]] point3 normal_of(const mesh& mesh, const face& f);

/// Whether two normals look away from each other.
[[nodiscard]] bool is_turned(const point3& normal, const point3& other);

/// `v` itself where it is zero.
[[nodiscard]] point3 with_length_one(const point3& v);

/// A property by its name, and where each input has it.
struct property {
    std::string name;
    scalar_type type;
    std::vector<const column*> of_input;  ///< null where it has none
};

/// The properties of an element that have one value a row, but for the normals of points.
[[nodiscard]] std::vector<property> properties_of(std::span<const carry_source> inputs,
                                                  const char* name);

/// That of the first file, if it is LAS: with a scale and an offset that hold the points of all, as
/// far as their headers say where these are, and with what any of them says of extra bytes.
///
/// \throws std::invalid_argument for files of different reference systems or ways to count GPS
///         time, unless `mixed`
[[nodiscard]] std::optional<las_header> join_las(std::span<const mesh_file> files,
                                                 std::span<const std::string> names, bool mixed);

/// A part with its own points.
struct solid_part {
    std::string name{};
    treeform::mesh mesh{};
    std::vector<std::uint32_t> faces{};   ///< [F] in the whole, ascending
    std::vector<std::uint32_t> points{};  ///< [V] in the whole, ascending
};

/// The parts of a file, as of `split_parts`, with their points; empty where there is but one.
[[nodiscard]] std::vector<solid_part> solid_parts(const carry_source& input);

}  // namespace treeform::detail::carry
