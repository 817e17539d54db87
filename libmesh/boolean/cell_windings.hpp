#pragma once
/// \file
/// How much of the way around a cell faces go.

#include <libmesh/boolean/cell_faces.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/function_ref.hpp>

#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

struct cell_windings {
    std::vector<double> winding;  ///< [C] in [0, 1]; 0 of the unbounded cell
    std::vector<double> area;     ///< [C] of the faces around it
};

/// The generalized winding number of each cell, without its sign, and no more than 1: on its side
/// of the middles of its 8 largest faces, averaged by their areas. Of closed faces it is the
/// winding number. None where `stop` says so.
///
/// Faces that are doubted count for half, and only for the cells that they bound. They end
/// somewhere, so they say something from near by, but from afar they add up to nonsense: a cell
/// amid twenty floors would have a winding number of about ten more or less.
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
