#pragma once
/// \file
/// Transfers texture coordinates and normals from the corners of the inputs to the corners of a
/// result.

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
void carry_corners(mesh_file& file, std::span<const carry_source> inputs,
                   const carried_elements& made);

/// Whether two triangles with a common edge have equal values at both of its ends; for normals, it
/// suffices that each triangle has a single one. `at_ends` has the corners of both triangles at
/// each end.
[[nodiscard]] bool look_alike(const corner_values& corners,
                              const std::array<std::uint32_t, 2>& triangles,
                              const std::array<std::array<std::size_t, 2>, 2>& at_ends);

}  // namespace treeform::detail::carry
