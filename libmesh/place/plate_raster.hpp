#pragma once
/// \file
/// Which cells of a plate or box a part covers, and where it finds free ones.

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

/// The cells that a part covers, by layer, row and column from the lowest ones on.
struct footprint {
    std::vector<cell_run> runs{};  ///< ascending, with gaps between
    std::size_t cells = 0;
    friend auto operator<=>(const footprint&, const footprint&) = default;
};

/// How space is cut into cells: cubes, or columns of any height in one layer.
struct cell_grid {
    point3 corner{};  ///< the lower left one of cell 0, 0, 0
    double cell = 0.0;
    bool layered = false;
};

/// The cells that the faces cover: every point of a face is in a cell of these or within 1e-6 of a
/// cell's length of one, so that a side exactly on a line between cells takes the cells on one side
/// of it. In layers, also the cells that these enclose on all sides.
///
/// \pre no used coordinate is below the corner, or more than 2^30 cells away
[[nodiscard]] footprint cells_covered(mesh_view mesh, const cell_grid& grid);

/// The same in the order in which a place that is not free is found out early: rows from all over
/// the part, long runs first.
[[nodiscard]] footprint telling_first(footprint part);

struct cell_place {
    std::uint32_t layer = 0, row = 0, column = 0;
    friend auto operator<=>(const cell_place&, const cell_place&) = default;
};

struct raster_size {
    std::uint32_t layers = 1, rows = 0, columns = 0;
};

/// Cells of a plate that nothing more may cover.
class plate_raster {
  public:
    /// Parts keep `spacing`, in cells, from each other; with `square` along an axis, which is more
    /// than needed but has boxes come in rows.
    plate_raster(const raster_size& size, double spacing, bool square);

    /// Takes the cells of a part that is there, and all that are nearer than the spacing to one.
    void take(const footprint& part);

    /// The lowest place from `from` on, row by row, at which a part fits between the cells taken;
    /// none beyond the layer, row and column of `last`.
    [[nodiscard]] std::optional<cell_place> first_free(const footprint& part, cell_place from,
                                                       cell_place last) const;

  private:
    struct reach_of_row {
        std::int64_t layers, rows;  ///< away
        std::int64_t columns;       ///< to either side
    };

    struct row_space {
        std::vector<std::uint64_t> blocked;  ///< bits of columns
        std::vector<std::uint64_t> any, shifted;
    };

    /// Marks the columns at which a part in this row covers a cell taken.
    void mark_blocked(const footprint& part, const cell_place& at, row_space& space) const;
    [[nodiscard]] std::size_t index_of(std::size_t layer, std::size_t row) const {
        return layer * size_.rows + row;
    }

    raster_size size_;
    std::size_t words_;                 ///< of a row
    std::vector<std::uint64_t> taken_;  ///< [layers][rows][words], column 0 is the lowest bit
    std::vector<bool> touched_;         ///< rows with a cell taken
    std::vector<reach_of_row> reach_;
};

}  // namespace treeform::detail::place
