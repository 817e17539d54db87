#pragma once
/// \file
/// A face cut at points that lie on it except for rounding.

#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::round {

/// Pieces whose edges add up to those of the face, wherever the points are. Computed in double, as
/// seen along the axis nearest to the face's normal.
class face_pieces {
  public:
    face_pieces(const face& whole, std::span<const point3> points);
    /// Of several faces that lie in one plane except for rounding.
    face_pieces(std::vector<face> faces, std::span<const point3> points);

    /// Puts points into the edge from `a` to `b`, in this order.
    void split_edge(std::uint32_t a, std::uint32_t b, std::span<const std::uint32_t> inner);
    /// Puts a point into the piece in which it seems to lie, if none has it yet.
    void split_inside(std::uint32_t p);
    /// Exchanges diagonals toward Delaunay's triangles where that moves the surface by at most
    /// `most`, but not the edges in `kept`, which are ascending, the lower end of each first. Bound
    /// of how far all of it has moved the surface.
    double flip(std::span<const std::array<std::uint32_t, 2>> kept, double most);
    /// Some may repeat a corner.
    [[nodiscard]] const std::vector<face>& all() const { return all_; }
    /// [piece] Of `before`, which cover the same places, the face that its middle seems to lie in.
    [[nodiscard]] std::vector<std::size_t> lying_in(std::span<const face> before) const;

  private:
    struct flat_point {
        double x = 0.0, y = 0.0;
    };
    [[nodiscard]] flat_point flat(std::uint32_t p) const;
    /// Twice the area of a, b, c, positive where they turn as the face does.
    [[nodiscard]] static double area(const flat_point& p, const flat_point& q, const flat_point& r);
    [[nodiscard]] double area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
    /// How well within a face p lies: the least share of a corner in it, below 0 outside.
    [[nodiscard]] double depth(const face& f, const flat_point& p) const;
    [[nodiscard]] bool in_circle(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                 std::uint32_t d) const;
    void split_at(std::uint32_t a, std::uint32_t b, std::uint32_t p);
    /// How thick the tetrahedron is that the two diagonals of four corners span.
    [[nodiscard]] double thickness(const std::array<std::uint32_t, 4>& corners) const;
    struct flips {
        bool any = false;
        double moved = 0.0;
    };
    flips flip_once(std::span<const std::array<std::uint32_t, 2>> kept, double most);

    std::span<const point3> points_;
    std::array<std::size_t, 2> axes_{};  ///< that are left of the three, in an order that turns
    point3 origin_{};
    std::vector<face> all_;
};

}  // namespace treeform::detail::round
