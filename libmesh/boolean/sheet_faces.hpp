#pragma once
/// \file
/// The faces of a sheet among solids: which they are, and which of them a set operation keeps.

#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/round/solid_faces.hpp>
#include <treeform/mesh/boolean.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::boolean {

/// [F'] 0 for faces of `cut` that are not of the sheet, 1 for those oriented as the lowest of its
/// faces there, 2 for those oriented the other way.
[[nodiscard]] std::vector<std::uint8_t> sheet_faces(
    const mesh_arrangement& cut, const std::vector<std::uint32_t>& operand_of_face,
    std::uint32_t sheet);

/// Faces of the sheet become covers both ways: then it is closed and bounds nothing, and cells are
/// those of the others.
void cover_from_both_sides(mesh_arrangement& cut, const std::vector<std::uint32_t>& operand_of_face,
                           std::uint32_t sheet);

/// The faces that the expression keeps, now first covered by the sheet. A piece is in a solid when
/// one of its sides is.
///
/// \param way as `sheet_faces` says
[[nodiscard]] round::solid_faces kept_of_sheet(
    mesh_arrangement& cut, const arrangement_cells& cells,
    const std::vector<std::uint32_t>& operand_of_face, const std::vector<std::uint8_t>& way,
    std::uint32_t sheet, const boolean_expression& expression, fill_rule rule);

}  // namespace treeform::detail::boolean
