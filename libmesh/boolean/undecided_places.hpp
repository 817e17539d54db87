#pragma once
/// \file
/// Where the faces of an arrangement are: in undecided space, or hidden.

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/arrange/patches.hpp>
#include <libmesh/boolean/undecided_space.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// The result's surface is in undecided space, and all that meets there has been cut. So a face of
/// the arrangement that has a point elsewhere is not of the result. Others have the same winding
/// numbers on all of a side, and edges between them say how these change.
class undecided_places {
  public:
    /// \param space none where all is undecided
    /// \pre   what is referred to outlives this
    /// \cost  O(F' log n) for n boxes of the space
    /// \same  on any number of threads
    undecided_places(const mesh_arrangement& cut, const undecided_space* space);

    /// [F'] 1 for faces all of which is in undecided space; empty where all are.
    [[nodiscard]] std::span<const std::uint8_t> is_within() const { return is_within_; }

    /// What an edge tells about the faces at it. Faces may be missing where there is only one.
    [[nodiscard]] arrange::edge_use use_of(const std::array<std::uint32_t, 2>& points,
                                           std::span<const arrange::face_side> sides) const;

    /// [patch] 1 for those that are not of the result, since a point of them is not in undecided
    /// space. A face that is not within it is a patch of its own.
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
