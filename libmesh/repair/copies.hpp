#pragma once
/// \file
/// Finds repeated faces.

#include <libmesh/repair/fill_hole.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::repair {

/// [F] 1 for the copies to delete: in parts of which every face has a copy, such as a sheet with a
/// back, all but one of the faces with the same corners. 0 for faces of other parts.
///
/// The remaining faces are consistently oriented, as the lowest face of the part, if the part can
/// be split into consistent sheets.
///
/// \param part_of [F] the part of each face, linked by edges
/// \param edges   of `faces`
[[nodiscard]] std::vector<std::uint8_t> copies_to_delete(std::span<const face> faces,
                                                         std::span<const std::uint32_t> part_of,
                                                         const directed_edges& edges);

}  // namespace treeform::detail::repair
