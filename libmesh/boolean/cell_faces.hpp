#pragma once
/// \file
/// The faces of an arrangement with the cells on their two sides, for labeling cells.

#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// The weight of a doubted face.
inline constexpr double share_doubted = 0.5;

/// A face of the arrangement.
struct cell_face {
    std::array<std::uint32_t, 2> cells{};  ///< in front and behind
    double area = 0.0;
    bool is_given = false;  ///< whether an input face other than a filling covers it
    bool is_outer = false;  ///< whether it is between the unbounded cell and another cell
    /// Whether it is inner, and linked to walls, that is, to inner faces that end somewhere
    /// (perhaps at outer faces). Faces of cavities and of overlapping shells are not.
    bool is_doubted = false;
    /// number of given faces of its orientation, minus those of the opposite one
    double times = 0.0;

    [[nodiscard]] bool separates() const { return cells[0] != cells[1]; }
};

/// All faces, with approximate points: relative to the center of the bounding box, in units of half
/// its longest side.
struct cell_faces {
    std::vector<cell_face> all;           ///< [F']
    std::vector<point3> points;           ///< of the arrangement
    double unit = 1.0;                    ///< half of the longest side of the box
    std::vector<std::size_t> begin;       ///< [C + 1] begin of the faces of each cell in `faces_at`
    std::vector<std::uint32_t> faces_at;  ///< faces that separate cells, cell by cell, ascending

    [[nodiscard]] std::span<const std::uint32_t> of_cell(std::size_t c) const {
        return {faces_at.data() + begin[c], begin[c + 1] - begin[c]};
    }
};

/// Outer faces are oriented outward, regardless of their input orientation, since they only make
/// sense if the inside is behind them. Faces with the same cell on both sides bound nothing, and
/// have `times` 0.
///
/// \param is_filling [F] of the input: 1 for fillings
/// \cost  O(F log d) for at most d faces at a point
/// \same  on any number of threads
[[nodiscard]] cell_faces find_cell_faces(const mesh_arrangement& cut,
                                         const arrangement_cells& cells, std::size_t cell_count,
                                         std::span<const std::uint32_t> is_filling);

}  // namespace treeform::detail::boolean
