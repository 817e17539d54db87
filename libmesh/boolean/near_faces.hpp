#pragma once
/// \file
/// The faces of two operands that can matter to each other.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// Faces of two operands in a region of space, with points of their own. Faces and points of both
/// operands are counted through, those of the first before those of the second.
struct near_faces {
    mesh local;                           ///< ascending; equal points of the operands are one
    std::uint32_t first_of_b = 0;         ///< local faces from here on are of the second
    std::vector<std::uint32_t> face_of;   ///< [F] face of an operand
    std::vector<std::uint32_t> point_of;  ///< [V] the lowest point of an operand, ascending
    std::array<aabb<double, 3>, 2> box;   ///< of each operand's points

    [[nodiscard]] std::size_t operand_of(std::size_t face) const {
        return face < first_of_b ? 0 : 1;
    }
};

/// All faces that reach into the box of the other operand, and all whose boxes meet the box of
/// those. Whatever lies in faces of the former kind is apart from all faces that are left out,
/// and these are outside the other operand.
///
/// None where it is seen that the operands are not sound (`is_sound`), or
/// that no such face is to be told: a point that faces use is not finite or beyond 2^1000, or two
/// points of one operand are equal.
///
/// \throws std::invalid_argument naming a face with a corner out of range
/// \cost   O(V + F), and a tenth of a microsecond for each face that stays
/// \same   on any number of threads
[[nodiscard]] std::optional<near_faces> find_near_faces(std::span<const mesh_view, 2> operands);

}  // namespace treeform::detail::boolean
