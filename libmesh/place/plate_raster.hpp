#pragma once
/// \file
/// The cells of a plate or box that a part covers, and the search for free positions.

#include <treeform/mesh/mesh.hpp>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace treeform::detail::place {

/// Cells [begin, end) of a row.
struct cell_run {
    std::uint32_t layer = 0, row = 0, begin = 0, end = 0;
    friend auto operator<=>(const cell_run&, const cell_run&) = default;
};

/// The cells that a part covers; layer, row and column count from its lowest ones.
struct footprint {
    std::vector<cell_run> runs{};  ///< ascending, neither overlapping nor adjacent
    std::size_t cells = 0;
    friend auto operator<=>(const footprint&, const footprint&) = default;
};

/// The division of space into cells: cubes if `layered`, else columns of unlimited height.
struct cell_grid {
    point3 corner{};  ///< lower left corner of cell 0, 0, 0
    double cell = 0.0;
    bool layered = false;
};

/// The cells that the faces cover. Every point of a face is in one of these cells or within 1e-6
/// cell sides of one, so that a side exactly between two cells takes only one of them. If
/// `layered`, cells that are enclosed on all sides are included.
///
/// \pre no used coordinate is below the corner, or more than 2^30 cells away
[[nodiscard]] footprint cells_covered(mesh_view mesh, const cell_grid& grid);

/// The same runs, ordered so that positions that are not free are rejected early: rows spread over
/// the part, long runs first.
[[nodiscard]] footprint telling_first(footprint part);

struct cell_place {
    std::uint32_t layer = 0, row = 0, column = 0;
    friend auto operator<=>(const cell_place&, const cell_place&) = default;
};

struct raster_size {
    std::uint32_t layers = 1, rows = 0, columns = 0;
};

/// The taken cells of a plate.
class plate_raster {
  public:
    /// Parts keep a distance of `spacing` cells; with `square`, along an axis, which is more than
    /// needed but aligns boxes in rows.
    plate_raster(const raster_size& size, double spacing, bool square);

    /// Takes the cells of a placed part, and all cells nearer than the spacing to one of them.
    void take(const footprint& part);

    /// The first position from `from` on, row by row, at which the part covers no taken cell; empty
    /// if there is none up to the layer, row and column of `last`.
    [[nodiscard]] std::optional<cell_place> first_free(const footprint& part, cell_place from,
                                                       cell_place last) const;

  private:
    struct reach_of_row {
        std::int64_t layers, rows;  ///< distance
        std::int64_t columns;       ///< taken to either side
    };

    struct row_space {
        std::vector<std::uint64_t> blocked;  ///< bits of columns
        std::vector<std::uint64_t> any, shifted;
    };

    /// Marks the columns at which a part in this row would cover a taken cell.
    void mark_blocked(const footprint& part, const cell_place& at, row_space& space) const;
    [[nodiscard]] std::size_t index_of(std::size_t layer, std::size_t row) const {
        return layer * size_.rows + row;
    }

    raster_size size_;
    std::size_t words_;                 ///< words in a row
    std::vector<std::uint64_t> taken_;  ///< [layers][rows][words], column 0 is the lowest bit
    std::vector<bool> touched_;         ///< rows with a taken cell
    std::vector<reach_of_row> reach_;
};

}  // namespace treeform::detail::place
