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

}  // namespace treeform::detail::arrange
