#pragma once
/// \file
/// A plate with parts on it, each checked against those that were there before.

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

/// A part turned about the vertical and moved to the origin: the least coordinates are exactly 0.
class turned_part {
  public:
    /// By `turn` times 15 degrees. \pre it has faces
    turned_part(mesh_view part, unsigned turn);

    [[nodiscard]] unsigned turn() const { return turn_; }
    [[nodiscard]] mesh_view mesh() const { return {points_, faces_}; }
    [[nodiscard]] const point3& size() const { return size_; }  ///< rounded; NaN if too large
    /// The map that the points of the part have gone through, then moved by `by`.
    [[nodiscard]] transform<3> matrix(const point3& by) const;

  private:
    unsigned turn_;
    std::span<const face> faces_;
    std::vector<point3> points_;
    std::array<double, 2> axis_{};  ///< cosine and sine
    point3 center_;                 ///< of the turn
    point3 lowest_;                 ///< after it, taken off
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
    /// The height and the area that its parts reach to, from its corner.
    [[nodiscard]] const point3& reached() const { return reached_; }

    /// Puts the part at a place of the raster, or near it toward the corner of the plate. False,
    /// and nothing is changed, when it would stick out or come too near to another part.
    bool put(std::uint32_t number, const prepared_mesh& whose, const turned& part, cell_place at);

    /// Moves its parts to where they belong in `result`; the plate is no more.
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
    point3 corner_;   ///< z of it is the bed, as written
    cell_grid grid_;  ///< from that corner
    double unit_;     ///< of the last place of coordinates on the plate
    plate_raster raster_;
    std::vector<resident> residents_;
    std::uint64_t measured_ = 0;
    point3 reached_{};
};

}  // namespace treeform::detail::place
