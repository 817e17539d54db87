#pragma once
/// \file
/// The loops in which one plane meets a mesh, without a computed coordinate.

#include <libmesh/cut/plane_levels.hpp>
#include <libmesh/exact/implicit_point.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::cut {

/// Where an edge meets a plane: its end below, and its end above; the same twice for a vertex in
/// the plane.
struct crossing {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    friend bool operator==(const crossing&, const crossing&) = default;
};

/// Loops of one plane, by their lowest faces.
struct layer_loops {
    struct loop {
        std::size_t first;
        std::size_t count;
        bool closed;
        bool oriented;
    };
    std::vector<loop> loops;
    std::vector<crossing> points;      ///< loop by loop; no two in a row are one point
    std::vector<std::uint32_t> faces;  ///< [points] of the side from each point to the next
};

/// The loops of plane k, as if it were a little lower.
///
/// \param faces those that have a corner below the plane, and one in or above it; ascending, with
///              three different corners
/// \cost  O(faces), predicates only at edges of more than two faces
[[nodiscard]] layer_loops loops_of(mesh_view mesh, const plane_levels& levels, std::uint32_t k,
                                   std::span<const std::uint32_t> faces);

/// The exact point.
[[nodiscard]] inline implicit_point exact_point(mesh_view mesh, const plane_levels& levels,
                                                std::uint32_t k, const crossing& c) {
    if (c.low == c.high) return mesh.points[c.low];
    return implicit_point::where_line_meets(mesh.points[c.low], mesh.points[c.high],
                                            levels.planes[k], levels.normal);
}

}  // namespace treeform::detail::cut
