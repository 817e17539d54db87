#pragma once
/// \file
/// Several meshes joined to one, with the sources of its elements.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

struct joined_operands {
    mesh all;  ///< no two points are equal, all points are corners
    /// [k + 1] first face of each operand, before any were omitted
    std::vector<std::uint32_t> first_face;
    /// [k + 1] first point of each operand, before equal points were joined
    std::vector<std::uint32_t> first_point;
    /// [V of `all`] the lowest point equal to it before joining; empty if nothing was omitted.
    std::vector<std::uint32_t> number_of_point;
    /// [F of `all`] its number before; empty if no face was omitted.
    std::vector<std::uint32_t> number_of_face{};

    /// [F of `all`] The operand of each face.
    [[nodiscard]] std::vector<std::uint32_t> operand_of_face() const;
    [[nodiscard]] operand_element face_source(std::uint32_t face) const;
    [[nodiscard]] operand_element point_source(std::uint32_t point) const;
};

/// \throws std::invalid_argument naming `function` and a face with a corner out of range, or
///         for more than 2^32 - 1 points or faces
void check_operands(const char* function, std::span<const mesh_view> operands);

/// \throws std::invalid_argument naming `function`, the operand and its lowest face with a corner
///         that is not finite or beyond 2^1000
/// \pre    the operands have been checked
void check_coordinates(const char* function, std::span<const mesh_view> operands);

/// \pre the operands have been checked
[[nodiscard]] joined_operands join_operands(std::span<const mesh_view> operands);

/// The same with only some of the faces, ascending, and their points.
[[nodiscard]] joined_operands part_of(const joined_operands& joined,
                                      std::span<const std::uint32_t> faces);

}  // namespace treeform::detail::boolean
