#pragma once
/// \file
/// The regions of space that patches bound.

#include <libmesh/arrange/face_side.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/arrange/numbered_sets.hpp>
#include <libmesh/arrange/patches.hpp>
#include <libmesh/base/union_find.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace treeform::detail::arrange {

/// Sets of patch sides next to the same region. Element 0 is the unbounded region.
class patch_regions {
  public:
    /// \pre `patches` outlives this
    explicit patch_regions(const surface_patches& patches)
        : patches_(patches), sets_(2 * std::size_t{patches.count()} + 1) {}

    void join(face_side s, face_side t) { sets_.join(element(s), element(t)); }
    void join_infinity(face_side s) { sets_.join(0, element(s)); }

    /// Joins the sides of neighbors about each edge that face each other.
    /// \throws std::logic_error naming an edge at which faces overlap
    void join_about_edges(mesh_view mesh, const mesh_arrangement& cut);
    /// The same only if both neighbors conduct. \param conduct [F'] 1 for faces that conduct, else
    /// 0
    void join_about_edges(mesh_view mesh, const mesh_arrangement& cut,
                          std::span<const std::uint8_t> conduct);

    /// The region of each element: of element 0, then of the front and the back of each patch.
    /// Region 0 is unbounded, the others are in the order of their lowest sides. Must be the last
    /// call.
    [[nodiscard]] numbered_sets number() { return number_sets(std::move(sets_)); }

  private:
    [[nodiscard]] std::uint32_t element(face_side s) const { return patches_.patch_side(s) + 1; }

    const surface_patches& patches_;
    base::union_find sets_;
};

}  // namespace treeform::detail::arrange
