#pragma once
/// \file
/// The radial order of faces about an edge.

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

/// Sorts the faces at edges of an arrangement by the planes of the input faces that contain them,
/// so that coordinates of constructed points are only used for the direction of the edge. Keeps its
/// memory between calls; not for several threads.
///
/// The angle of a face about the edge is that of its normal, or of the opposite normal if the face
/// runs backward ("its normal" below). For an edge e, n x m is along e if m is less than half a
/// turn ahead of n.
class radial_order {
  public:
    radial_order(mesh_view mesh, const mesh_arrangement& cut) : mesh_(mesh), cut_(cut) {}

    /// Sorts `sides`, all faces at the edge, counter-clockwise about it, starting with the first
    /// one. Returns false if two overlap, which does not occur in a valid arrangement; the order is
    /// then invalid.
    /// \cost O(d log d) predicates for d faces
    [[nodiscard]] bool sort(const std::array<std::uint32_t, 2>& points, std::span<face_side> sides);

    /// Of `sides`, the faces at the edge from `from` toward `toward`, the last one before the
    /// half-plane from the edge in direction +x. None if two overlap.
    /// \pre  `sides` is not empty, no face is in that half-plane, and the edge is not parallel to x
    /// \cost O(d) predicates
    [[nodiscard]] std::optional<face_side> last_before_x(const point3& from, const point3& toward,
                                                         std::span<const face_side> sides);

  private:
    struct member {
        plane_points plane;
        std::uint32_t cover;  ///< an input face in this plane
        face_side side;
        int half;  ///< angle from the first face: 1 less than half a turn, 2 half a turn, 3 more

        /// +1 if its normal is that of the plane, -1 if opposite.
        [[nodiscard]] int sense() const { return is_behind(side) ? -1 : 1; }
    };

    void collect(std::span<const face_side> sides);
    [[nodiscard]] bool opposed(const member& m, const member& n) const;

    mesh_view mesh_;
    const mesh_arrangement& cut_;
    std::vector<member> members_;
};

}  // namespace treeform::detail::arrange
