#pragma once
/// \file
/// The order of faces about an edge.

#include <libmesh/arrange/face_side.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/exact/plane_predicates.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::arrange {

/// Sorts the faces at edges of an arrangement by the planes of the input faces they lie in, so that
/// no coordinate of a constructed point is looked at but to see which way the edge runs. Keeps its
/// memory between calls; a thread has its own.
///
/// A face is turned about the edge as its normal is, or the opposite normal where the face runs
/// backwards: "its normal" below. For an edge e, n x m is along e when m is less than half a turn
/// ahead of n.
class radial_order {
  public:
    radial_order(mesh_view mesh, const mesh_arrangement& cut) : mesh_(mesh), cut_(cut) {}

    /// Puts `sides`, all faces at the edge, in counter-clockwise order about it, the first one
    /// staying where it is. Returns false when two lie on top of each other, as they do in no
    /// arrangement; the order then means nothing.
    /// \cost O(d log d) predicates for d faces
    [[nodiscard]] bool sort(const std::array<std::uint32_t, 2>& points, std::span<face_side> sides);

    /// Of `sides`, faces at the edge from `from` toward `toward`, the one that comes last before
    /// the half-plane from the edge in direction +x. None when two lie on top of each other.
    /// \pre  there is one, none is in that half-plane, and the edge is not parallel to x
    /// \cost O(d) predicates
    [[nodiscard]] std::optional<face_side> last_before_x(const point3& from, const point3& toward,
                                                         std::span<const face_side> sides);

  private:
    struct member {
        plane_points plane;
        std::uint32_t cover;  ///< input face that lies in it
        face_side side;
        int half;  ///< how far from where one begins: 1 less than half a turn, 2 half, 3 more

        /// +1 when its normal is that of the plane, -1 when it is the opposite.
        [[nodiscard]] int sense() const { return is_behind(side) ? -1 : 1; }
    };

    void collect(std::span<const face_side> sides);
    [[nodiscard]] bool opposed(const member& m, const member& n) const;

    mesh_view mesh_;
    const mesh_arrangement& cut_;
    std::vector<member> members_;
};

}  // namespace treeform::detail::arrange
