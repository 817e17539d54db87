#pragma once
/// \file
/// Cells of an arrangement labeled inside or outside, where faces disagree about it.

#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/boolean/minimum_cut.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// A choice, and what speaks against it. Areas are those of the points as approximated.
struct labeled_cells {
    std::vector<std::uint8_t> inside;  ///< [C] 0 for the unbounded one
    double dropped_area = 0.0;         ///< of given faces with the same label on both sides
    double flipped_area = 0.0;         ///< of given faces with the inside in front
};

/// The labels with the least disagreement. None where `stop` says so.
///
/// Disagreement is an area:
/// - of a cell that is inside (1 - w) times the area around it, of one that is outside w times, for
///   its winding number w (`find_cell_windings`);
/// - of an outer face, between the unbounded cell and another one, its own where that is outside:
///   then it is lost from sight;
/// - of an inner face a quarter of its own where it has the same on both sides, all of it with the
///   inside in front, none with the inside behind; half of that where it is doubted;
/// - of a filling, which is a guess and counts for no winding number, half of it where it
///   separates.
///
/// The area around a cell and not its volume is its weight, since faces are weighed by area, too:
/// so the unit of length is of no effect, and what is thin counts for as much as can be seen of it.
///
/// This is a least cut of a network with a node for each cell. Capacities are whole numbers: areas
/// in shares of 2^-40 of all area. Of several labelings with the least disagreement, it is that
/// with the fewest cells inside.
///
/// \param is_filling [F] of the input: 1 for fillings
/// \pre    `cells` are those of `open_cells_of`
/// \cost   that of `find_cell_windings`, and of `minimum_cut` for the cells and the faces between
///         them
/// \same   on any number of threads
/// \source Jacobson, Kavan and Sorkine-Hornung, Robust Inside-Outside Segmentation using
///         Generalized Winding Numbers, SIGGRAPH 2013, section 4; Diazzi and Attene, Convex
///         Polyhedral Meshing for Robust Solid Modeling, SIGGRAPH Asia 2021, section 5, for cells
///         of an arrangement
[[nodiscard]] std::optional<labeled_cells> label_cells(const mesh_arrangement& cut,
                                                       const arrangement_cells& cells,
                                                       std::size_t count,
                                                       std::span<const std::uint32_t> is_filling,
                                                       function_ref<bool()> stop);

}  // namespace treeform::detail::boolean
