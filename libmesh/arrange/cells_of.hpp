#pragma once
/// \file
/// The cells of what is known to be an arrangement.

#include <libmesh/arrange/cells.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace treeform::detail::arrange {

/// As `find_cells`, which checks its arguments first.
[[nodiscard]] arrangement_cells cells_of(mesh_view mesh, const mesh_arrangement& cut,
                                         std::span<const std::uint32_t> operand_of_face,
                                         std::size_t operand_count);

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
