#include <libmesh/intersect/mesh_pair_sieve.hpp>

#include <algorithm>

namespace treeform::detail::intersect {

void mesh_pair_sieve::add(const candidate_block& block) {
    output_.box_pairs += block.first.size();
    for (std::size_t i = 0; i < block.first.size(); ++i) {
        prefetch(block, i);
        add_pair({input_.a.face_at(block.first[i]), input_.b.face_at(block.second[i])});
    }
    decider_.finish();
}

/// Faces and points are scattered over memory: what is needed some candidates later is asked for
/// now. A corner may be no point; asking for what is nowhere is allowed.
void mesh_pair_sieve::prefetch(const candidate_block& block, std::size_t i) const {
    constexpr std::size_t faces_ahead = 24, points_ahead = 12;
    if (i + faces_ahead < block.second.size())
        input_.b.prefetch_face(block.second[i + faces_ahead]);
    if (i + points_ahead < block.second.size())
        input_.b.prefetch_points(block.second[i + points_ahead]);
}

void mesh_pair_sieve::add_pair(const face_numbers& pair) {
    if (pair.a != last_a_) {
        has_a_ = input_.a.corners(pair.a, corners_of_a_);
        last_a_ = pair.a;
    }
    triangle3 b;
    const bool has_b = input_.b.corners(pair.b, b);
    if (!has_a_) bad_.in_a = std::min(bad_.in_a, pair.a);
    if (!has_b) bad_.in_b = std::min(bad_.in_b, pair.b);
    if (has_a_ && has_b) decider_.add(pair, corners_of_a_, b);
}

}  // namespace treeform::detail::intersect
