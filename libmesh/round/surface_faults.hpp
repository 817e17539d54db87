#pragma once
/// \file
/// Finds the defects of a surface of which most faces are certified, that is, known to meet each
/// other only in common corners and edges.

#include <libmesh/round/turned_faces.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace treeform::detail::round {

struct surface_faults {
    std::vector<std::uint32_t> degenerate;  ///< faces, ascending
    std::vector<face_pair> pairs;  ///< pairs of faces that meet beyond common corners and edges
    /// if there are no other defects: faces without the outside in front and the inside behind,
    /// ascending
    std::vector<std::uint32_t> turned;
    bool open = false;  ///< whether the signed face count of an edge is not zero
    bool cancelled = false;
};

struct surface_check {
    /// [F] 1 for certified faces: not degenerate, and meeting each other only in common corners and
    /// edges, on these coordinates. Empty if there are none.
    std::span<const std::uint8_t> certified{};
    /// Whether the surface must bound a solid: then edges and the inside are checked, too. Edges at
    /// which all faces are certified are known to be closed.
    bool solid = true;
    /// Upper bound of the displacement, in each coordinate, of points of faces that are not
    /// certified, from positions where all faces had the inside behind; infinite if points were
    /// joined.
    double moved = std::numeric_limits<double>::infinity();
    winding_of_rest rest{};  ///< if further faces bound the solid, at edges of certified faces
    progress_callback progress{};
};

/// Exact. Tests the faces that are not certified against all faces, and checks their edges; does
/// not test certified faces against each other. Also checks parts that may have been turned inside
/// out (`find_turned_faces`).
///
/// \pre  coordinates are finite, corners in range
/// \cost as `self_intersections` of the faces that are not certified and those whose boxes meet
///       theirs, and a box query for each face; as `find_turned_faces`
/// \same on any number of threads
[[nodiscard]] surface_faults find_faults(mesh_view surface, const surface_check& check);

}  // namespace treeform::detail::round
