#pragma once
/// \file
/// Detects sets of faces that form a height field over a plane. They cannot intersect, so none of
/// their pairs has to be tested.
///
/// Let all faces of a patch have the same orientation in a projection along a line, say
/// counterclockwise. Then the number of faces over a point of the plane is the winding number of
/// the patch's border around it, where the border consists of the directed edges of all faces after
/// opposite ones cancel. If 1. edges of the border meet in the projection only at end points that
/// they share by number, and 2. the border winds around no point more than once, then no two faces
/// overlap in the projection, and two faces A and B meet in space only in corners and edges that
/// they share by number. Proof: let q be a point of both, p its projection. p is inside neither
/// face, since the other would overlap it. If p is on a canceled edge of A, or at a corner of A all
/// of whose edges canceled, the faces at that edge or corner cover a neighborhood of p; so B, which
/// does not overlap them, is one of them. Otherwise p is on border edges of A and, for the same
/// reason, of B. If these are the same edge, it has only one face, on its left: A is B. If not, by
/// 1, p is a corner shared by both. A projection along a tilted line is rounded; conclusions from
/// it hold for all points within `slack_` of the rounded ones, and so for the exact projection.
///
/// \source Volino and Magnenat-Thalmann, Efficient self-collision detection on smoothly discretized
///         surface animations using geometrical shape regularity, Computer Graphics Forum 13(3),
///         1994, section 2: the same two conditions for a continuous surface. Here conditions are
///         tested by winding numbers, so a patch need not be a disk, nor have manifold vertices.

#include <libmesh/intersect/pair_filter.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace treeform::detail::intersect {

/// Tests patches one after the other. Size: 250 kB, of which a patch of 64 faces uses 5 kB, of 512
/// faces 40 kB.
class height_field_test {
  public:
    static constexpr std::size_t max_faces = 4096;

    /// \pre no coordinate is beyond `largest_filtered_coordinate`
    explicit height_field_test(points_view points) : points_(points) {}

    /// Whether `patch` is certainly a height field: along the axis that it faces most, or along the
    /// mean of its normals.
    /// \pre  the patch has 1 to `max_faces` faces
    /// \cost O(F + B^2) for B border edges
    [[nodiscard]] bool operator()(std::span<const numbered_face> patch);

  private:
    static constexpr std::size_t max_border = 640;
    static constexpr std::size_t max_keys = 3 * max_faces + max_border;
    static constexpr int max_slot_bits = 15;

    /// A projection along a line onto the coordinate plane perpendicular to an axis, and the
    /// orientation of faces in it: +1 counterclockwise, -1 clockwise.
    struct view {
        std::size_t axis = 0;
        int turn = 1;
        /// Slope of the line: its change along the two next axes for 1 along the axis.
        double tilt_1 = 0.0, tilt_2 = 0.0;
    };
    /// An edge of the border, the patch on its left.
    struct border_edge {
        std::uint32_t from, to;
        point2 a, b;      ///< its ends in the projection
        point2 min, max;  ///< its box
    };

    [[nodiscard]] std::optional<view> find_view(std::span<const numbered_face> patch) const;
    [[nodiscard]] bool all_turn(std::span<const numbered_face> patch, const view& seen) const;
    [[nodiscard]] bool all_turn_tilted(std::span<const numbered_face> patch,
                                       const view& seen) const;
    void project_border(const view& seen);
    [[nodiscard]] int orient(const point2& a, const point2& b, const point2& c) const;
    [[nodiscard]] bool is_below(double x, double y) const;
    [[nodiscard]] bool on_one_side(const point2& a, const point2& b, const point2& c,
                                   const point2& d) const;
    [[nodiscard]] bool part_at(const point2& v, const point2& a, const point2& b) const;
    [[nodiscard]] std::optional<bool> is_between(const point2& v, const point2& a, const point2& c,
                                                 const point2& b) const;
    [[nodiscard]] bool find_border(std::span<const numbered_face> patch, const view& seen);
    [[nodiscard]] std::uint32_t number_of(std::uint64_t key);
    [[nodiscard]] std::span<border_edge> border() { return std::span(border_).first(border_size_); }
    [[nodiscard]] bool are_apart(const border_edge& e, const border_edge& f) const;
    [[nodiscard]] bool meets_itself();
    [[nodiscard]] bool winds_once();
    [[nodiscard]] std::uint32_t edge_from(std::uint32_t corner);
    void find_components();
    [[nodiscard]] bool alternates(std::uint32_t corner);
    [[nodiscard]] bool starts_outside(std::uint32_t component);

    points_view points_;
    double slack_ = 0.0;  ///< largest error of a coordinate of the projection
    // A hash table. For an edge, from its lower to its higher corner: the number of faces that run
    // that way minus those that run back. For a corner of the border, stored as an edge from itself
    // to itself: 1 + the number of a border edge that starts there.
    std::array<std::uint16_t, 1 << max_slot_bits> slots_;  ///< numbers, or 0
    std::array<std::uint64_t, 1 + max_keys> keys_;
    std::array<std::int16_t, 1 + max_keys> values_;
    int slot_bits_ = 0;  ///< of the table, for the current patch
    std::uint32_t key_count_ = 0;
    std::size_t border_size_ = 0;
    std::array<border_edge, max_border> border_;
    /// component of each edge, as its first edge
    std::array<std::uint32_t, max_border> component_;
};

}  // namespace treeform::detail::intersect
