#pragma once
/// \file
/// Candidates of two meshes without triangle blocks, for the narrow phase.

#include <libmesh/intersect/two_mesh_pairs.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/answers.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace treeform::detail::intersect {

/// One of two meshes: its faces by their places in the tree, transformed.
class mesh_side {
  public:
    mesh_side(mesh_view mesh, const tree<3>& tree, const transform<3>& move)
        : mesh_(mesh), ids_(tree.ids()), move_(move), moves_(move != transform<3>{}) {}

    [[nodiscard]] std::uint32_t face_at(std::uint32_t place) const { return ids_[place]; }

    /// Gets the corners of a face; false if one is out of range.
    [[nodiscard]] bool corners(std::uint32_t id, triangle3& triangle) const {
        const face& f = mesh_.faces[id];
        for (std::size_t k = 0; k < 3; ++k) {
            if (f[k] >= mesh_.points.size()) return false;
            triangle[k] = mesh_.points[f[k]];
            if (moves_) triangle[k] = move_(triangle[k]);
        }
        return true;
    }

    /// Prefetch what `corners` reads: first the face, some time later its points.
    void prefetch_face(std::uint32_t place) const { __builtin_prefetch(&mesh_.faces[ids_[place]]); }
    void prefetch_points(std::uint32_t place) const {
        const face& f = mesh_.faces[ids_[place]];
        for (const std::uint32_t corner : f) __builtin_prefetch(mesh_.points.data() + corner);
    }

  private:
    mesh_view mesh_;
    std::span<const std::uint32_t> ids_;
    transform<3> move_;
    bool moves_;
};

/// Gets the corners of candidates from the meshes.
class face_candidates : public two_mesh_pairs {
  public:
    struct input {
        mesh_side a;
        mesh_side b;
    };

    face_candidates(const input& meshes, bad_faces& bad) : two_mesh_pairs(bad), meshes_(meshes) {}

    void offer(const candidate_block& block, narrow_phase<face_candidates>& phase);

  private:
    void prefetch(const candidate_block& block, std::size_t i) const;

    const input& meshes_;
    /// The last face of `a`; candidates of the same face are consecutive.
    std::uint32_t last_a_ = bad_faces::none;
    bool has_a_ = false;
    triangle3 corners_of_a_;
};

}  // namespace treeform::detail::intersect
