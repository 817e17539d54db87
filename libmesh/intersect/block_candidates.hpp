#pragma once
/// \file
/// Candidates of two meshes whose triangles are stored in blocks, for the narrow phase.

#include <libmesh/intersect/block_planes.hpp>
#include <libmesh/intersect/two_mesh_pairs.hpp>
#include <libmesh/nearness/triangle_blocks.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/answers.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace treeform::detail::intersect {

/// One of two meshes: the blocks of its tree, transformed.
class block_side {
  public:
    block_side(const buffer<nearness::eight_triangles>& blocks, const tree<3>& tree,
               const transform<3>& move)
        : blocks_(blocks.data()), ids_(tree.ids()), move_(move), moves_(move != transform<3>{}) {}

    [[nodiscard]] std::uint32_t face_at(std::size_t place) const { return ids_[place]; }

    /// The triangles of a block; if they are transformed, in `space`.
    [[nodiscard]] const nearness::eight_triangles& block(std::uint32_t i,
                                                         nearness::eight_triangles& space) const {
        if (!moves_) return blocks_[i];
        nearness::move_triangles(blocks_[i], move_, 1.0, space);
        return space;
    }

    void prefetch(std::uint32_t i) const {
        const auto* at = reinterpret_cast<const char*>(blocks_ + i);
        for (std::size_t byte = 0; byte < sizeof(nearness::eight_triangles); byte += 64)
            __builtin_prefetch(at + byte);
        __builtin_prefetch(ids_.data() + std::size_t{i} * 8);
    }

  private:
    const nearness::eight_triangles* blocks_;
    std::span<const std::uint32_t> ids_;
    transform<3> move_;
    bool moves_;
};

/// Rejects candidates by the planes of their triangles, one against eight at a time. Size: 4 kB.
class block_candidates : public two_mesh_pairs {
  public:
    struct input {
        block_side a;
        block_side b;
    };

    block_candidates(const input& meshes, bad_faces& bad) : two_mesh_pairs(bad), meshes_(meshes) {}

    void offer(const candidate_block& block, narrow_phase<block_candidates>& phase);

  private:
    void look_at(std::uint32_t block_a, std::uint32_t block_b, nearness::slot_pairs& pairs,
                 narrow_phase<block_candidates>& phase);
    void load(std::uint32_t block_a, std::uint32_t block_b);

    static constexpr std::uint32_t none = 0xFFFFFFFF;
    const input& meshes_;
    /// The current blocks; candidates of the same block of `a` are consecutive.
    std::uint32_t at_a_ = none;
    std::uint32_t at_b_ = none;
    const nearness::eight_triangles* in_a_ = nullptr;
    const nearness::eight_triangles* in_b_ = nullptr;
    nearness::eight_triangles space_a_;
    nearness::eight_triangles space_b_;
    block_planes planes_a_;
    block_planes planes_b_;
};

}  // namespace treeform::detail::intersect
