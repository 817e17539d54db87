#pragma once
/// \file
/// Which cells of a plate a part covers, seen from above, and where it finds free ones.

#include <treeform/mesh/mesh.hpp>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::place {

/// Cells [begin, end) of a row.
struct cell_run {
    std::uint32_t row = 0, begin = 0, end = 0;
    friend auto operator<=>(const cell_run&, const cell_run&) = default;
};

/// The cells that a part covers, by row and column from the lowest ones on.
struct footprint {
    std::vector<cell_run> runs{};  ///< ascending, with gaps between
    std::size_t cells = 0;
    friend auto operator<=>(const footprint&, const footprint&) = default;
};

/// The cells of length `cell` that the faces cover, where `corner_x`, `corner_y` is the lower left
/// corner of cell 0, 0: every point of a face is in a cell of these or within 1e-6 of a cell's
/// length of one, so that a side exactly on a line between cells takes the cells on one side of it.
///
/// \pre no used coordinate is more than 2^30 cells away
[[nodiscard]] footprint cells_covered(mesh_view mesh, double corner_x, double corner_y,
                                      double cell);

struct cell_place {
    std::uint32_t row = 0, column = 0;
    friend auto operator<=>(const cell_place&, const cell_place&) = default;
};

/// Cells of a plate that nothing more may cover.
class plate_raster {
  public:
    /// `width` x `height` cells. Parts keep `spacing`, in cells, from each other; with `square` in
    /// x or in y, which is more than needed but has boxes come in rows.
    plate_raster(std::uint32_t width, std::uint32_t height, double spacing, bool square);

    /// Takes the cells of a part that is there, and all that are nearer than the spacing to one.
    void take(const footprint& part);

    /// The lowest place from `from` on, row by row, at which a part fits between the cells taken;
    /// none beyond the row and column of `last`.
    [[nodiscard]] std::optional<cell_place> first_free(const footprint& part, cell_place from,
                                                       cell_place last) const;

  private:
    /// Bits of the columns [0, columns) at which a part in this row covers a cell taken.
    void mark_blocked(const footprint& part, std::uint32_t row,
                      std::span<std::uint64_t> blocked) const;

    std::uint32_t height_;
    std::size_t words_;                 ///< of a row
    std::vector<std::uint64_t> taken_;  ///< [height][words], column 0 is the lowest bit
    std::vector<bool> touched_;         ///< rows with a cell taken
    std::vector<std::int64_t> reach_;   ///< columns to either side, by rows away
};

}  // namespace treeform::detail::place
