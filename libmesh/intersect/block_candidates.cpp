#include <libmesh/intersect/block_candidates.hpp>

#include <algorithm>
#include <bit>

namespace treeform::detail::intersect {

void block_candidates::offer(const candidate_block& block, narrow_phase<block_candidates>& phase) {
    constexpr std::size_t ahead = 24;
    const std::size_t count = block.first.size();
    // The search hands out all candidates of two leaf blocks in a row.
    for (std::size_t i = 0; i < count;) {
        const std::uint32_t block_a = block.first[i] / 8, block_b = block.second[i] / 8;
        nearness::slot_pairs pairs{};
        for (; i < count && block.first[i] / 8 == block_a && block.second[i] / 8 == block_b; ++i)
            pairs[block.first[i] % 8] |= 1U << block.second[i] % 8;
        const std::size_t later = std::min(i + ahead, count - 1);
        meshes_.a.prefetch(block.first[later] / 8);
        meshes_.b.prefetch(block.second[later] / 8);
        look_at(block_a, block_b, pairs, phase);
    }
    phase.finish<candidate_classes::separate>();
}

void block_candidates::look_at(std::uint32_t block_a, std::uint32_t block_b,
                               nearness::slot_pairs& pairs, narrow_phase<block_candidates>& phase) {
    load(block_a, block_b);
    drop_beyond_planes(planes_a_, planes_b_, pairs);
    for (std::size_t i = 0; i < 8; ++i) {
        if (pairs[i] == 0) continue;
        const triangle3 a = in_a_->triangle(i);
        const std::uint32_t face_a = meshes_.a.face_at(std::size_t{block_a} * 8 + i);
        for (unsigned rest = pairs[i]; rest != 0; rest &= rest - 1) {
            const auto j = static_cast<std::size_t>(std::countr_zero(rest));
            offer_pair({face_a, meshes_.b.face_at(std::size_t{block_b} * 8 + j)}, a,
                       in_b_->triangle(j), phase);
        }
    }
}

void block_candidates::load(std::uint32_t block_a, std::uint32_t block_b) {
    const bool new_a = block_a != at_a_;
    if (new_a) in_a_ = &meshes_.a.block(block_a, space_a_);
    if (block_b != at_b_) in_b_ = &meshes_.b.block(block_b, space_b_);
    const point3 origin{in_a_->at[0][0][0], in_a_->at[0][1][0], in_a_->at[0][2][0]};
    if (new_a) find_planes(*in_a_, origin, planes_a_);
    if (new_a || block_b != at_b_) find_planes(*in_b_, origin, planes_b_);
    at_a_ = block_a;
    at_b_ = block_b;
}

}  // namespace treeform::detail::intersect
