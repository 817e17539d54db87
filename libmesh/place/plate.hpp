#pragma once
/// \file
/// A plate with parts on it, each checked against those that were there before. The cells of a
/// plate or box that a part covers, and where it finds free ones.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/pack.hpp>
#include <treeform/tree/tree.hpp>

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
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

/// A part rotated about the vertical and moved so that its least coordinates are exactly 0.
class turned_part {
  public:
    /// Rotates by `turn` times 15 degrees. \pre the part has faces
    turned_part(mesh_view part, unsigned turn);

    [[nodiscard]] unsigned turn() const { return turn_; }
    [[nodiscard]] mesh_view mesh() const { return {points_, faces_}; }
    /// of its box, rounded; NaN on overflow
    [[nodiscard]] const point3& size() const { return size_; }
    /// The transform from the original part to this one moved by `by`.
    [[nodiscard]] transform<3> matrix(const point3& by) const;

  private:
    unsigned turn_;
    std::span<const face> faces_;
    std::vector<point3> points_;
    std::array<double, 2> axis_{};  ///< cosine and sine
    point3 center_;                 ///< center of the turn
    point3 lowest_;                 ///< least coordinates after the turn, which are subtracted
    point3 size_;
};

/// A part in a turn, with its tree.
struct turned {
    turned_part part;
    tree<3> faces;

    turned(mesh_view mesh, unsigned turn);
};

class plate {
  public:
    /// \pre `cell` is not 0
    plate(const pack_options& options, double cell, bool square);

    [[nodiscard]] const plate_raster& raster() const { return raster_; }
    [[nodiscard]] std::uint64_t pairs_measured() const { return measured_; }
    /// The extent of its parts along each axis, from its corner.
    [[nodiscard]] const point3& reached() const { return reached_; }

    /// Puts the part at a position of the raster, or near it, closer to the corner of the plate.
    /// Returns false, and changes nothing, when the part would stick out or be too near to another
    /// part.
    bool put(std::uint32_t number, const prepared_mesh& whose, const turned& part, cell_place at);

    /// Moves its parts into `result`, by part number; the plate is consumed.
    void take_parts(std::vector<packed_part>& result);

  private:
    struct resident {
        std::uint32_t number;
        packed_part part;
        const prepared_mesh* whose;
        tree<3> faces_tree;
        box3 box;

        [[nodiscard]] mesh_view mesh() const { return {part.points, whose->indexed_view().faces}; }
    };

    [[nodiscard]] resident at(std::uint32_t number, const prepared_mesh& whose,
                              const turned_part& part, const point3& by) const;
    [[nodiscard]] bool fits(const resident& one);
    [[nodiscard]] bool inside(const box3& box) const;
    [[nodiscard]] bool apart(const resident& a, const resident& b);
    [[nodiscard]] double next_above(double below) const;
    [[nodiscard]] double snapped(double at, std::size_t axis) const;
    void slide(const turned& part, point3& by) const;
    [[nodiscard]] double distance_to(const std::vector<const resident*>& others, const turned& part,
                                     const point3& by, double most) const;
    [[nodiscard]] double free_travel(const turned& part, const point3& by, std::size_t axis) const;

    pack_options options_;
    bool single_;     ///< whether float32 is written
    point3 corner_;   ///< its z is the bed, as written
    cell_grid grid_;  ///< from that corner
    double unit_;     ///< unit in the last place of coordinates on the plate
    plate_raster raster_;
    std::vector<resident> residents_;
    std::uint64_t measured_ = 0;
    point3 reached_{};
};

}  // namespace treeform::detail::place
