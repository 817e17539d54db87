#pragma once
/// \file
/// What the faces of an arrangement say of the cells on their two sides.

#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// Of what a doubted face says, this share counts.
inline constexpr double share_doubted = 0.5;

/// What is known of a face of the arrangement.
struct cell_face {
    std::array<std::uint32_t, 2> cells{};  ///< in front and behind
    double area = 0.0;
    bool is_given = false;  ///< not only fillings cover it
    bool is_outer = false;  ///< between the unbounded cell and another one
    /// Inner, and linked to walls: to inner faces that end somewhere, at outer ones perhaps. Those
    /// of cavities and of shells that overlap do not.
    bool is_doubted = false;
    double times = 0.0;  ///< given faces that run as it does, less those that run against it

    [[nodiscard]] bool separates() const { return cells[0] != cells[1]; }
};

/// The faces, with points as approximated: about the middle of the bounding box, in halves of its
/// longest side.
struct cell_faces {
    std::vector<cell_face> all;           ///< [F']
    std::vector<point3> points;           ///< of the arrangement
    double unit = 1.0;                    ///< half of the longest side
    std::vector<std::size_t> begin;       ///< [C + 1] where the faces of each cell begin
    std::vector<std::uint32_t> faces_at;  ///< cell by cell, ascending; those that separate

    [[nodiscard]] std::span<const std::uint32_t> of_cell(std::size_t c) const {
        return {faces_at.data() + begin[c], begin[c + 1] - begin[c]};
    }
};

/// Outer faces are outward, however they were: what is behind them is meant to be inside, or they
/// are in vain. Faces with one cell on both sides bound nothing and count 0 times.
///
/// \param is_filling [F] of the input: 1 for fillings
/// \cost  O(F log d) for at most d faces at a point
/// \same  on any number of threads
[[nodiscard]] cell_faces find_cell_faces(const mesh_arrangement& cut,
                                         const arrangement_cells& cells, std::size_t cell_count,
                                         std::span<const std::uint32_t> is_filling);

}  // namespace treeform::detail::boolean
