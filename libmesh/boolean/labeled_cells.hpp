#pragma once
/// \file
/// Labels the cells of an arrangement inside or outside if faces are inconsistent.

#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/boolean/minimum_cut.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// Labels, and the areas that contradict them. Areas are those of the approximate points.
struct labeled_cells {
    std::vector<std::uint8_t> inside;  ///< [C] 1 for cells inside; 0 for the unbounded cell
    double dropped_area = 0.0;         ///< area of given faces with the same label on both sides
    double flipped_area = 0.0;         ///< area of given faces with the inside in front
};

/// The labels with the least disagreement. None if `stop` returned true.
///
/// Disagreement is an area:
/// - for a cell with winding number w (`find_cell_windings`), (1 - w) times the area around it if
///   it is inside, w times that area if it is outside;
/// - for an outer face, between the unbounded cell and another cell, its own area if that cell is
///   outside, since the face then disappears;
/// - for an inner face, a quarter of its area if both sides have the same label, all of it if the
///   inside is in front, none if the inside is behind; half of that if the face is doubted;
/// - for a filling, which is a guess and does not count in winding numbers, half of its area if it
///   separates inside and outside.
///
/// Cells are weighted by the area around them, not by volume, since faces are weighted by area,
/// too: so the unit of length has no effect, and thin cells count by their visible area.
///
/// This is a minimum cut of a network with a node for each cell. Capacities are integers: areas in
/// units of 2^-40 of the total area. Of several labelings with the least disagreement, the one with
/// the fewest cells inside is returned.
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
