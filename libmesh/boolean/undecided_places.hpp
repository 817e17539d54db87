#pragma once
/// \file
/// Which faces of an arrangement are in undecided space, and which are hidden.

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/arrange/patches.hpp>
#include <libmesh/boolean/undecided_space.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// The surface of the result is in undecided space, where all faces that meet have been cut. So a
/// face of the arrangement with a point outside of undecided space is not on the result. On the
/// other faces, winding numbers are constant on each side, and change at edges by the faces there.
class undecided_places {
  public:
    /// \param space null if all space is undecided
    /// \pre   the arguments outlive this
    /// \cost  O(F' log n) for n boxes of the space
    /// \same  on any number of threads
    undecided_places(const mesh_arrangement& cut, const undecided_space* space);

    /// [F'] 1 for faces that are entirely in undecided space; empty if all are.
    [[nodiscard]] std::span<const std::uint8_t> is_within() const { return is_within_; }

    /// How an edge links the faces at it. If it has only one face, others may have been dropped.
    [[nodiscard]] arrange::edge_use use_of(const std::array<std::uint32_t, 2>& points,
                                           std::span<const arrange::face_side> sides) const;

    /// [patch] 1 for patches that are not on the result, since they have a point outside of
    /// undecided space. A face that is not entirely in undecided space is a patch of its own.
    [[nodiscard]] std::vector<std::uint8_t> hidden(const arrange::surface_patches& patches) const;

  private:
    [[nodiscard]] aabb<double, 3> box_of(std::uint32_t point) const;
    [[nodiscard]] std::array<aabb<double, 3>, 3> corners_of(const face& f) const;
    void find();

    const mesh_arrangement& cut_;
    const undecided_space* space_;
    std::vector<std::uint8_t> is_within_{};
};

}  // namespace treeform::detail::boolean
