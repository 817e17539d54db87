#pragma once
/// \file
/// The cells of a valid arrangement.

#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/numbered_sets.hpp>
#include <libmesh/arrange/patches.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::arrange {

/// As `find_cells`, without checking the arguments.
[[nodiscard]] arrangement_cells cells_of(mesh_view mesh, const mesh_arrangement& cut,
                                         std::span<const std::uint32_t> operand_of_face,
                                         std::size_t operand_count);

/// The cells on both sides of patches, numbered as by `patch_regions`, for operands that are
/// closed. Winding numbers are not computed.
[[nodiscard]] numbered_sets cells_between(mesh_view mesh, const mesh_arrangement& cut,
                                          std::span<const std::uint32_t> operand_of_face,
                                          const surface_patches& patches);

/// [F'][2] the cells on both sides of each face, from those of its patch.
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> cells_beside_faces(
    const mesh_arrangement& cut, const surface_patches& patches, const numbered_sets& cells);

/// The cells of faces that may be open, without winding numbers.
struct open_cells {
    std::size_t count = 0;    ///< cell 0 is the unbounded one
    arrangement_cells cells;  ///< only `cell_of_side` is set
};

/// All faces separate cells, even those whose covers cancel out. At an open edge, both sides of the
/// surface are in one cell.
/// \same on any number of threads
[[nodiscard]] open_cells open_cells_of(mesh_view mesh, const mesh_arrangement& cut);

}  // namespace treeform::detail::arrange
