#pragma once
/// \file
/// Faces that lie on others altogether.

#include <libmesh/repair/fill_hole.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::repair {

/// [F] 1 for the copies to delete of parts every face of which has one, as has a sheet with a back:
/// all but one of the faces with the same corners. 0 for faces of other parts.
///
/// Those that are left run the same way round where two of them share an edge, if the part can be
/// split into sheets that do; which way, its lowest face says.
///
/// \param part_of [F] by edges
/// \param edges   of `faces`
[[nodiscard]] std::vector<std::uint8_t> copies_to_delete(std::span<const face> faces,
                                                         std::span<const std::uint32_t> part_of,
                                                         const directed_edges& edges);

}  // namespace treeform::detail::repair
