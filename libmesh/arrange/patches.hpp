#pragma once
/// \file
/// The faces of an arrangement joined to patches, and the edges at which patches meet.

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

/// Edges at which other than two faces meet, or two that run the same way.
struct junction_list {
    struct edge {
        std::array<std::uint32_t, 2> points;  ///< ascending
        std::size_t begin;                    ///< where its faces begin in `sides`
    };
    std::vector<edge> edges;
    std::vector<face_side> sides;  ///< edge by edge, ascending

    [[nodiscard]] std::span<const face_side> sides_of(std::size_t e) const {
        const std::size_t end = e + 1 < edges.size() ? edges[e + 1].begin : sides.size();
        return {sides.data() + edges[e].begin, end - edges[e].begin};
    }
};

/// A patch is a set of faces linked by edges at which two faces meet that run opposite ways: on
/// each side of it is one cell, and the same covers it throughout where nothing is open.
struct surface_patches {
    numbered_sets patch;                      ///< of each face; in the order of their lowest faces
    std::vector<junction_list> junctions;     ///< in pieces, in the order of the edges
    std::vector<open_arrangement_edge> open;  ///< the first
    std::uint64_t open_count = 0;

    [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(patch.count()); }
    [[nodiscard]] std::uint32_t first_face(std::uint32_t p) const { return patch.lowest[p]; }
    /// The side of its patch, as that of a face.
    [[nodiscard]] face_side patch_side(face_side side) const {
        return 2 * patch[face_of(side)] + (side & 1U);
    }
};

/// \cost O(V' + F' log d) for at most d faces at a point
/// \same on any number of threads
[[nodiscard]] surface_patches find_patches(const mesh_arrangement& cut,
                                           std::span<const std::uint32_t> operand_of_face);

/// What an edge of an arrangement from which faces are missing is good for.
enum class edge_use : std::uint8_t {
    nothing,   ///< faces may be missing there: it links nothing, is no junction, and not open
    junction,  ///< all are there, but it does not make two faces one patch
    all
};
using edge_judge = function_ref<edge_use(const std::array<std::uint32_t, 2>& points,
                                         std::span<const face_side> sides)>;

/// The same where faces are missing.
[[nodiscard]] surface_patches find_patches(const mesh_arrangement& cut,
                                           std::span<const std::uint32_t> operand_of_face,
                                           edge_judge judge);

/// The same of operands known to be closed.
/// \throws std::logic_error naming an edge at which faces are missing all the same
[[nodiscard]] surface_patches find_closed_patches(const mesh_arrangement& cut,
                                                  std::span<const std::uint32_t> operand_of_face,
                                                  edge_judge judge);

}  // namespace treeform::detail::arrange
