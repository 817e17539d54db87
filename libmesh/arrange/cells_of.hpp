#pragma once
/// \file
/// The cells of what is known to be an arrangement.

#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/numbered_sets.hpp>
#include <libmesh/arrange/patches.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::arrange {

/// As `find_cells`, which checks its arguments first.
[[nodiscard]] arrangement_cells cells_of(mesh_view mesh, const mesh_arrangement& cut,
                                         std::span<const std::uint32_t> operand_of_face,
                                         std::size_t operand_count);

/// The cells on both sides of patches, as `patch_regions` numbers them: of faces that are closed,
/// operand by operand. What winds around them is not asked.
[[nodiscard]] numbered_sets cells_between(mesh_view mesh, const mesh_arrangement& cut,
                                          std::span<const std::uint32_t> operand_of_face,
                                          const surface_patches& patches);

/// [F'][2] the cells on both sides of faces, from those of their patches.
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> cells_beside_faces(
    const mesh_arrangement& cut, const surface_patches& patches, const numbered_sets& cells);

/// The cells of faces that may be open, which have no winding numbers.
struct open_cells {
    std::size_t count = 0;    ///< cell 0 is the unbounded one
    arrangement_cells cells;  ///< with `cell_of_side` alone
};

/// Every face counts, whatever covers it: also faces that cancel out separate cells. Where the
/// surface ends, both of its sides look into one cell.
/// \same on any number of threads
[[nodiscard]] open_cells open_cells_of(mesh_view mesh, const mesh_arrangement& cut);

}  // namespace treeform::detail::arrange
