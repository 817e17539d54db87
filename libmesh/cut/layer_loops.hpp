#pragma once
/// \file
/// The loops in which a plane intersects a mesh, found without computing coordinates.

#include <libmesh/cut/plane_levels.hpp>
#include <libmesh/exact/implicit_point.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::cut {

/// The intersection of an edge with a plane: the end below and the end above; for a vertex in the
/// plane, that vertex twice.
struct crossing {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    friend bool operator==(const crossing&, const crossing&) = default;
};

/// The loops of one plane, in the order of their lowest faces.
struct layer_loops {
    struct loop {
        std::size_t first;
        std::size_t count;
        bool closed;
        bool oriented;
    };
    std::vector<loop> loops;
    std::vector<crossing> points;  ///< loop by loop; consecutive points are different
    /// [points] face that contains the side from each point to the next
    std::vector<std::uint32_t> faces;
};

/// The loops of plane k; vertices in the plane count as above it.
///
/// \param faces the faces with a corner below the plane and one in or above it; ascending, each
///              with three different corners
/// \cost  O(faces), predicates only at edges of more than two faces
[[nodiscard]] layer_loops loops_of(mesh_view mesh, const plane_levels& levels, std::uint32_t k,
                                   std::span<const std::uint32_t> faces);

/// The exact position of a crossing.
[[nodiscard]] inline implicit_point exact_point(mesh_view mesh, const plane_levels& levels,
                                                std::uint32_t k, const crossing& c) {
    if (c.low == c.high) return mesh.points[c.low];
    return implicit_point::where_line_meets(mesh.points[c.low], mesh.points[c.high],
                                            levels.planes[k], levels.normal);
}

}  // namespace treeform::detail::cut
