#include <libmesh/intersect/face_candidates.hpp>

namespace treeform::detail::intersect {

void face_candidates::offer(const candidate_block& block, narrow_phase<face_candidates>& phase) {
    for (std::size_t i = 0; i < block.first.size(); ++i) {
        prefetch(block, i);
        const face_numbers pair{meshes_.a.face_at(block.first[i]),
                                meshes_.b.face_at(block.second[i])};
        if (pair.a != last_a_) {
            has_a_ = meshes_.a.corners(pair.a, corners_of_a_);
            last_a_ = pair.a;
        }
        triangle3 b;
        const bool has_b = meshes_.b.corners(pair.b, b);
        if (has_a_ && has_b)
            offer_pair(pair, corners_of_a_, b, phase);
        else
            refuse(pair, !has_a_, !has_b);
    }
    phase.finish<candidate_classes::separate>();
}

/// Faces and points are scattered over memory: what is needed some candidates later is asked for
/// now. A corner may be no point; asking for what is nowhere is allowed.
void face_candidates::prefetch(const candidate_block& block, std::size_t i) const {
    constexpr std::size_t faces_ahead = 24, points_ahead = 12;
    if (i + faces_ahead < block.second.size())
        meshes_.b.prefetch_face(block.second[i + faces_ahead]);
    if (i + points_ahead < block.second.size())
        meshes_.b.prefetch_points(block.second[i + points_ahead]);
}

}  // namespace treeform::detail::intersect
