#pragma once
/// \file
/// Joins the faces of an arrangement to patches, and finds the edges at which patches meet.

#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/face_side.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/arrange/numbered_sets.hpp>
#include <treeform/tree/detail/function_ref.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::arrange {

/// Junctions: edges that do not have exactly two consistently oriented faces.
struct junction_list {
    struct edge {
        std::array<std::uint32_t, 2> points;  ///< ascending
        std::size_t begin;                    ///< begin of its faces in `sides`
    };
    std::vector<edge> edges;
    std::vector<face_side> sides;  ///< face sides, edge by edge, ascending

    [[nodiscard]] std::span<const face_side> sides_of(std::size_t e) const {
        const std::size_t end = e + 1 < edges.size() ? edges[e + 1].begin : sides.size();
        return {sides.data() + edges[e].begin, end - edges[e].begin};
    }
};

/// A patch is a set of faces linked by edges with exactly two, consistently oriented faces. On each
/// side of a patch is one cell. If nothing is open, the covering operands are the same on all of a
/// patch.
struct surface_patches {
    numbered_sets patch;  ///< [F'] patch of each face; in the order of their lowest faces
    std::vector<junction_list> junctions;     ///< in pieces, ordered by edge
    std::vector<open_arrangement_edge> open;  ///< the first open edges
    std::uint64_t open_count = 0;

    [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(patch.count()); }
    [[nodiscard]] std::uint32_t first_face(std::uint32_t p) const { return patch.lowest[p]; }
    /// The side of the patch that contains a face side, encoded like a face side.
    [[nodiscard]] face_side patch_side(face_side side) const {
        return 2 * patch[face_of(side)] + (side & 1U);
    }
};

/// \cost O(V' + F' log d) for at most d faces at a point
/// \same on any number of threads
[[nodiscard]] surface_patches find_patches(const mesh_arrangement& cut,
                                           std::span<const std::uint32_t> operand_of_face);

/// How an edge is used in an arrangement from which faces were dropped.
enum class edge_use : std::uint8_t {
    /// faces may be missing: it links nothing, is no junction, and does not count as open
    nothing,
    junction,  ///< complete, but always a junction
    all
};
using edge_judge = function_ref<edge_use(const std::array<std::uint32_t, 2>& points,
                                         std::span<const face_side> sides)>;

/// The same for an arrangement with missing faces; `judge` decides the use of each edge.
[[nodiscard]] surface_patches find_patches(const mesh_arrangement& cut,
                                           std::span<const std::uint32_t> operand_of_face,
                                           edge_judge judge);

/// The same for operands known to be closed.
/// \throws std::logic_error naming an edge that is open nevertheless
[[nodiscard]] surface_patches find_closed_patches(const mesh_arrangement& cut,
                                                  std::span<const std::uint32_t> operand_of_face,
                                                  edge_judge judge);

}  // namespace treeform::detail::arrange
