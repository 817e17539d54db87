#pragma once
/// \file
/// The faces of a sheet among solids: which they are, and which of them a set operation keeps.

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/round/solid_faces.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::boolean {

/// [F'] 0 for faces of `cut` that are not of the sheet, 1 for those oriented as the lowest of its
/// faces there, 2 for those oriented the other way.
[[nodiscard]] std::vector<std::uint8_t> sheet_faces(
    const mesh_arrangement& cut, const std::vector<std::uint32_t>& operand_of_face,
    std::uint32_t sheet);

/// Those of the sheet that are kept, now first covered by the sheet.
///
/// \param way  as `sheet_faces` says
/// \param keep [F'] not 0 for faces to keep
[[nodiscard]] round::solid_faces kept_of_sheet(mesh_arrangement& cut,
                                               const std::vector<std::uint32_t>& operand_of_face,
                                               const std::vector<std::uint8_t>& way,
                                               const std::vector<std::uint8_t>& keep,
                                               std::uint32_t sheet);

}  // namespace treeform::detail::boolean
