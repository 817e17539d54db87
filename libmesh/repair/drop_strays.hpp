#pragma once
/// \file
/// Pieces of surface that bound nothing.

#include <libmesh/repair/working_mesh.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::repair {

struct dropped_strays {
    std::uint64_t faces = 0;
    std::vector<std::uint32_t> walls{};  ///< sources of those that went as walls, ascending
};

/// What becomes of patches that end at others or hang on them.
enum class walls : std::uint8_t { go, stay };

/// Drops patches that bound nothing.
///
/// - A patch with a free border and less than `share` of the area goes where it is nearly flat (its
///   border, squared, is more than 8 times its area: a hemisphere has 6.3, a disk 12.6), so that
///   filling its holes would make next to nothing of it. So does a flat patch of one or two faces
///   and less than 1 % of the area, where these are less than 5 % together.
/// - A patch that hangs on others and has a free border goes where it is so small or nearly flat.
/// - A patch that only ends at other faces, as a wall inside a solid does, goes where each of
///   these edges has an odd number of faces, and an even one without it; the smallest first. That
///   is a guess: of three patches that end at one loop, any could be the wall.
///
/// \param is_sheet keep free borders: only walls go
dropped_strays drop_strays(working_mesh& mesh, double share, bool is_sheet,
                           walls inner = walls::go);

}  // namespace treeform::detail::repair
