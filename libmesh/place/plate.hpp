#pragma once
/// \file
/// A plate with parts, each checked against the parts placed before it.

#include <libmesh/place/plate_raster.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/pack.hpp>
#include <treeform/tree/tree.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::place {

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

        [[nodiscard]] mesh_view mesh() const { return {part.points, whose->view().faces}; }
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
