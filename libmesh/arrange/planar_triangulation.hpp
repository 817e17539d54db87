#pragma once
/// \file
/// Constrained triangulation of coplanar points, some of them constructed.

#include <libmesh/exact/implicit_point.hpp>

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::arrange {

/// An incremental constrained triangulation: inserts points one by one, and forces segments.
///
/// The topology is exact. Whether a point lies on a line by its definition is looked up and never
/// computed, since filters cannot decide collinear points. The triangulation is nearly Delaunay:
/// approximate in-circle tests choose among valid triangulations.
///
/// \source Sloan, A fast algorithm for generating constrained Delaunay triangulations, Computers
///         and Structures 47 (1993); crossing segments are split at their intersection
class planar_triangulation {
  public:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    /// Returns the point where segments of two lines cross.
    using crossing = std::function<implicit_point(std::uint32_t line, std::uint32_t other)>;

    /// Starts with the triangle of the first three of `points`, which is counter-clockwise, seen
    /// against `axis` times `orientation` (+1 or -1), and contains all others, perhaps on its
    /// sides.
    ///
    /// \param lines_of  the lines on which each point is known to lie, ascending
    ///
    /// Uses the memory resource of `points`.
    planar_triangulation(std::pmr::vector<implicit_point> points,
                         std::pmr::vector<std::pmr::vector<std::uint32_t>> lines_of, int axis,
                         int orientation, crossing cross);

    /// Inserts a point, and returns its vertex: the point itself, or an equal one.
    std::uint32_t insert(std::uint32_t point);

    /// Forces the segment between two vertices, and returns the vertices along it, from the first
    /// to the last. At a crossing with an earlier segment, a new point is created.
    std::pmr::vector<std::uint32_t> constrain(std::uint32_t from, std::uint32_t to,
                                              std::uint32_t line);

    [[nodiscard]] std::size_t triangle_count() const { return origin_.size() / 3; }
    [[nodiscard]] std::array<std::uint32_t, 3> corners(std::size_t t) const {
        return {origin_[3 * t], origin_[3 * t + 1], origin_[3 * t + 2]};
    }
    /// The neighbor across the side from corner i to the next, or none.
    [[nodiscard]] std::uint32_t across(std::size_t t, std::size_t i) const {
        const std::uint32_t twin = twin_[3 * t + i];
        return twin == none ? none : twin / 3;
    }
    /// The triangle to the left of the side from one vertex to another. \pre there is such a side
    [[nodiscard]] std::uint32_t left_of(std::uint32_t from, std::uint32_t to) const;

    /// All points: the given ones, then the created ones.
    [[nodiscard]] std::span<const implicit_point> points() const { return points_; }
    /// The two lines that cross at a created point. \pre `point` is not a given point
    [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> made_by(std::uint32_t point) const {
        return made_by_[point - given_];
    }

  private:
    using half_edge = std::uint32_t;  ///< 3 t + i: from corner i of triangle t to the next

    struct place {
        half_edge at;  ///< a side of the triangle; or the side, or a side that begins at the vertex
        int on_sides;  ///< 0: inside, 1: on the side, 2: on the vertex
    };

    /// Where a segment leaves the star of a vertex: at a vertex, or else across a side.
    struct star_exit {
        std::uint32_t met = none;
        half_edge crossed = none;
    };
    using side_queue = std::pmr::deque<std::array<std::uint32_t, 2>>;  ///< ends of sides

    static half_edge next(half_edge h) { return h % 3 == 2 ? h - 2 : h + 1; }
    static half_edge previous(half_edge h) { return h % 3 == 0 ? h + 2 : h - 1; }
    [[nodiscard]] std::uint32_t target(half_edge h) const { return origin_[next(h)]; }
    [[nodiscard]] std::uint32_t apex(half_edge h) const { return origin_[previous(h)]; }

    void note_line(std::uint32_t p, std::uint32_t line);
    [[nodiscard]] int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
    [[nodiscard]] bool known_collinear(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
    /// Whether b and c are on the same side of a. \pre collinear, different from a
    [[nodiscard]] bool is_ahead(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;

    [[nodiscard]] place locate(std::uint32_t p);
    [[nodiscard]] half_edge side_toward(std::uint32_t t, std::uint32_t p, std::uint32_t first,
                                        half_edge from, place& found) const;
    [[nodiscard]] half_edge find(std::uint32_t from, std::uint32_t to) const;
    [[nodiscard]] half_edge side_between(std::uint32_t u, std::uint32_t v) const;
    class star;
    template <class Visit>
    void around(std::uint32_t vertex, const Visit& visit) const;

    void set(half_edge h, std::uint32_t origin, half_edge twin, std::uint32_t line);
    std::uint32_t add_triangle();
    void split_triangle(std::uint32_t t, std::uint32_t p);
    void split_side(half_edge h, std::uint32_t p);
    void flip(half_edge h);
    [[nodiscard]] bool can_flip(half_edge h) const;
    [[nodiscard]] bool wants_flip(half_edge h) const;
    void improve_around(std::uint32_t p);
    void improve(std::pmr::vector<std::array<std::uint32_t, 2>>& sides);

    void mark(half_edge h, std::uint32_t line);
    /// One step of `constrain`: returns the next vertex along the segment, to which there now is a
    /// marked side.
    std::uint32_t advance(std::uint32_t from, std::uint32_t to, std::uint32_t line);
    [[nodiscard]] star_exit leave(std::uint32_t from, std::uint32_t to) const;
    /// Flips sides until none crosses the segment, and returns the new sides.
    std::pmr::vector<std::array<std::uint32_t, 2>> flip_away(std::uint32_t from, std::uint32_t to,
                                                             side_queue& sides);
    std::uint32_t make_crossing(half_edge side, std::uint32_t line);

    std::pmr::vector<implicit_point> points_;
    /// approximate positions, for heuristic choices
    std::pmr::vector<std::array<double, 2>> plan_;
    std::pmr::vector<std::pmr::vector<std::uint32_t>> lines_of_;
    std::pmr::vector<std::pair<std::uint32_t, std::uint32_t>> made_by_;
    std::pmr::vector<std::uint32_t> origin_;  ///< origin of each half-edge
    std::pmr::vector<half_edge> twin_;
    std::pmr::vector<std::uint32_t> line_;  ///< the line on which the side is forced, or none
    std::pmr::vector<half_edge> leaving_;   ///< for each vertex, a half-edge that begins there
    std::pmr::vector<half_edge> opposite_;  ///< memory of `improve_around`
    std::size_t given_;
    int axis_;
    int orientation_;
    crossing cross_;
    std::uint32_t last_ = 0;  ///< triangle at which the next search begins
};

}  // namespace treeform::detail::arrange
