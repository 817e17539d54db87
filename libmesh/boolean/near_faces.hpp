#pragma once
/// \file
/// The faces of two operands that can matter to each other, and on which side the others are.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/buffer.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

using prepared_pair = std::array<const prepared_mesh*, 2>;

/// Of each operand, the pairs of its faces that meet beyond shared corners.
using own_pairs = std::array<std::span<const face_pair>, 2>;

/// Where a face that no face of the other operand reaches is.
enum class face_place : std::uint8_t { near, outside, inside };

/// Faces of two operands near where their surfaces meet, with points of their own. Faces and points
/// of both operands are counted through, those of the first before those of the second.
struct near_faces {
    mesh local;                           ///< ascending; equal points of the operands are one
    std::uint32_t first_of_b = 0;         ///< local faces from here on are of the second
    std::vector<std::uint32_t> face_of;   ///< [F] face of an operand
    std::vector<std::uint32_t> point_of;  ///< [V] the lowest point of an operand, ascending
    std::vector<face_pair> pairs;         ///< of local faces that meet beyond shared corners
    buffer<face_place> place;             ///< of all faces of both operands

    [[nodiscard]] std::size_t operand_of(std::size_t face) const {
        return face < first_of_b ? 0 : 1;
    }
};

/// Near are the faces whose boxes overlap that of a face that meets the other operand. So whatever
/// lies in the box of a face that is cut has nothing in common with the box of a face that is not
/// near.
///
/// Of the others, those at a common point are all inside or all outside the other operand. So are
/// those of leaf blocks whose boxes none of the other's overlap, and of such blocks that overlap.
/// Of each set that this makes, one point is asked.
///
/// What only later operations gain by is not prepared where there is just one, `once`.
///
/// \pre    both operands are sound (`is_sound`)
/// \cost   that of the faces that meet, O(F / 8) besides, and 1 byte a face
/// \same   on any number of threads
[[nodiscard]] near_faces find_near_faces(const prepared_pair& operands, bool once);

/// The same of operands whose faces meet each other: near, too, are faces whose boxes overlap that
/// of a face of `own`, and faces with a point of a near one. The place of the others is not asked: it
/// is `outside`.
///
/// \pre no two vertices of an operand have equal coordinates, and no face is degenerate
[[nodiscard]] near_faces find_near_faces(const prepared_pair& operands, const own_pairs& own,
                                         bool once);

}  // namespace treeform::detail::boolean
