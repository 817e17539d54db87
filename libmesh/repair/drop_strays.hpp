#pragma once
/// \file
/// Drops pieces of surface that bound nothing.

#include <libmesh/repair/working_mesh.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::repair {

struct dropped_strays {
    std::uint64_t faces = 0;
    std::vector<std::uint32_t> walls{};  ///< sources of faces dropped as walls, ascending
};

/// Whether patches that end at other patches, or are attached to them, are dropped or kept.
enum class walls : std::uint8_t { drop, keep };

/// Drops patches that bound nothing.
///
/// - A patch with a free border and less than `share` of the area is dropped if it is nearly flat
///   (border length squared > 8 times the area; 6.3 for a hemisphere, 12.6 for a disk), since
///   filling its holes would enclose almost nothing. So is a flat patch of one or two faces with
///   less than 1 % of the area, if all such patches together have less than 5 %.
/// - A patch that is attached to others, and has a free border, is dropped if it is that small or
///   nearly flat.
/// - A patch that only ends at other faces, like a wall inside a solid, is dropped if each of these
///   edges has an odd number of faces, and an even number without it; the smallest first. This is a
///   heuristic: of three patches that end at one loop, any could be the wall.
///
/// \param is_sheet keep free borders, and drop only walls
dropped_strays drop_strays(working_mesh& mesh, double share, bool is_sheet,
                           walls inner = walls::drop);

}  // namespace treeform::detail::repair
