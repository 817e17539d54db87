#pragma once
/// \file
/// Faces that form a height field over a coordinate plane: they cannot meet, and no pair of them
/// has to be tested.
///
/// Let all faces of a patch turn the same way in a projection along an axis, say counterclockwise.
/// Then every face counts as +1 where its projection lies, and the number of faces over a point of
/// the plane is the winding number of the patch's border around it: the border is what remains of
/// the directed edges of all faces after opposite ones have canceled. If
/// 1. edges of the border meet in the projection only at end points they share by number, and
/// 2. the border winds around no point more than once,
/// then no two faces overlap in the projection, and two faces A and B meet in space only at what
/// they share by number. For let q be a point of both, p its projection. It lies inside neither
/// face, since the other one would overlap it. Where p is on an edge of A that has canceled, or at
/// a corner of A all of whose edges have, the faces of that edge or corner cover a neighborhood of
/// p; so B, which must not overlap them, is one of them. Else p is on border edges of A and, for
/// the same reason, of B. If they are one edge, it has faces on its left only, and only one: A is
/// B. If not, p is by 1 a corner that both share.
///
/// \source Volino and Magnenat-Thalmann, Efficient self-collision detection on smoothly discretized
///         surface animations using geometrical shape regularity, Computer Graphics Forum 13(3),
///         1994, section 2: the same two conditions for a continuous surface. Counting by winding
///         numbers is ours: it asks neither for a disk nor for manifold vertices.

#include <libmesh/intersect/pair_filter.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace treeform::detail::intersect {

/// Tests patches one after the other. 50 kB, 24 of them in the inner loop.
class height_field_test {
  public:
    static constexpr std::size_t max_faces = 512;

    /// \pre no coordinate is beyond `largest_filtered_coordinate`
    explicit height_field_test(points_view points) : points_(points) {}

    /// Whether `patch` is certainly a height field over the coordinate plane that it faces most.
    /// \pre  there are 1 to `max_faces`
    /// \cost O(F + B^2) for B border edges
    [[nodiscard]] bool operator()(std::span<const numbered_face> patch);

  private:
    static constexpr std::size_t max_border = 256;
    static constexpr std::size_t max_keys = 3 * max_faces + max_border;
    static constexpr int slot_bits = 12;

    /// A projection, and how faces turn in it: +1 counterclockwise, -1 clockwise.
    struct view {
        int axis = 0;
        int turn = 1;
    };
    /// An edge of the border, the patch on its left.
    struct border_edge {
        std::uint32_t from, to;
        point2 a, b;      ///< its ends in the projection
        point2 min, max;  ///< its box
    };

    [[nodiscard]] std::optional<view> find_view(std::span<const numbered_face> patch) const;
    [[nodiscard]] bool find_border(std::span<const numbered_face> patch, const view& seen);
    [[nodiscard]] std::uint32_t number_of(std::uint64_t key);
    [[nodiscard]] std::span<border_edge> border() { return std::span(border_).first(border_size_); }
    [[nodiscard]] static bool are_apart(const border_edge& e, const border_edge& f);
    [[nodiscard]] bool meets_itself();
    [[nodiscard]] bool winds_once();
    [[nodiscard]] std::uint32_t edge_from(std::uint32_t corner);
    void find_components();
    [[nodiscard]] bool alternates(std::uint32_t corner);
    [[nodiscard]] bool starts_outside(std::uint32_t component);

    points_view points_;
    // A hash table: of an edge, from its lower to its higher corner, how often faces run along it
    // that way, less how often they run back; of a corner of the border, which is an edge from
    // itself to itself, 1 + the number of a border edge that leaves it.
    std::array<std::uint16_t, 1 << slot_bits> slots_;  ///< numbers, or 0
    std::array<std::uint64_t, 1 + max_keys> keys_;
    std::array<std::int16_t, 1 + max_keys> values_;
    std::uint32_t key_count_ = 0;
    std::size_t border_size_ = 0;
    std::array<border_edge, max_border> border_;
    std::array<std::uint32_t, max_border> component_;  ///< of each edge, by its first one
};

}  // namespace treeform::detail::intersect
