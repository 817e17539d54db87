#pragma once
/// \file
/// Generalized winding numbers of cells.

#include <libmesh/boolean/cell_faces.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/function_ref.hpp>

#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

struct cell_windings {
    std::vector<double> winding;  ///< [C] in [0, 1]; 0 for the unbounded cell
    std::vector<double> area;     ///< [C] area of the faces around each cell
};

/// The generalized winding number of each cell, without its sign and at most 1: the mean at the
/// centers of its 8 largest faces, on the cell's side, weighted by area. For closed faces it is the
/// winding number. None if `stop` returned true.
///
/// Doubted faces have half the weight, and count only for the cells that they bound. They end
/// somewhere, so they are informative nearby, but meaningless in sum from afar: a cell amid twenty
/// floors would have a winding number that is wrong by about ten.
///
/// \param faces of the arrangement
/// \cost  O(F log^2 F), and 8 solid angles for each side of a doubted face
/// \same  on any number of threads
/// \source Jacobson, Kavan and Sorkine-Hornung, Robust Inside-Outside Segmentation using
///         Generalized Winding Numbers, SIGGRAPH 2013
[[nodiscard]] std::optional<cell_windings> find_cell_windings(const cell_faces& known,
                                                              std::span<const face> faces,
                                                              function_ref<bool()> stop);

}  // namespace treeform::detail::boolean
