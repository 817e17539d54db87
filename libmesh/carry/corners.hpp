#pragma once
/// \file
/// Texture coordinates and normals of the inputs' corners, for the corners of what is made of them.

#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/carry.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

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

}  // namespace treeform::detail::carry
