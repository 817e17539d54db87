#include <libmesh/exact/predicates.hpp>
#include <libmesh/intersect/detail/mesh_pair_sieve.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace tf::detail {
namespace {

/// Whether no coordinate is NaN or larger in magnitude than `limit`.
bool within(const triangle3& t, double limit) {
    bool all = true;
    for (const point3& p : t)
        all &= (std::abs(p.x) <= limit) & (std::abs(p.y) <= limit) & (std::abs(p.z) <= limit);
    return all;
}

}  // namespace

void mesh_pair_sieve::add(const candidate_block& block) {
    output_.box_pairs += block.first.size();
    for (std::size_t i = 0; i < block.first.size(); ++i) {
        prefetch(block, i);
        add_pair({input_.a.face_at(block.first[i]), input_.b.face_at(block.second[i])});
        if (count_ == pair_batch<6>::capacity) filter();
    }
    filter();
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
    constexpr double limit = largest_filtered_coordinate;
    if (pair.a != last_a_) {
        has_a_ = input_.a.corners(pair.a, corners_of_a_);
        last_a_ = pair.a;
    }
    const triangle3& a = corners_of_a_;
    triangle3 b;
    const bool has_b = input_.b.corners(pair.b, b);
    if (!(has_a_ && has_b && within(a, limit) && within(b, limit))) {
        constexpr double largest = std::numeric_limits<double>::max();
        const bool good_a = has_a_ && within(a, largest);
        const bool good_b = has_b && within(b, largest);
        if (!good_a) bad_.in_a = std::min(bad_.in_a, pair.a);
        if (!good_b) bad_.in_b = std::min(bad_.in_b, pair.b);
        if (good_a && good_b) decide(pair, a, b);
        return;
    }
    pairs_[count_] = pair;
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            batch_.at[k][axis][count_] = a[k][axis];
            batch_.at[k + 3][axis][count_] = b[k][axis];
        }
    ++count_;
}

void mesh_pair_sieve::filter() {
    if (count_ == 0) return;
    constexpr std::size_t vector_pairs = 8;                   // at most in a vector of the filter
    for (std::size_t i = count_; i % vector_pairs != 0; ++i)  // the last vector, to its end
        for (auto& corner : batch_.at)
            for (auto& axis : corner) axis[i] = axis[0];
    const batch_verdict verdict = filter_separate_pairs(batch_, count_);
    const std::uint64_t in_use = ~std::uint64_t{0} >> (pair_batch<6>::capacity - count_);
    count_ = 0;
    for (std::uint64_t rest = verdict.pierce & in_use; rest != 0; rest &= rest - 1)
        record(pairs_[static_cast<std::size_t>(std::countr_zero(rest))], pair_kind::crossing);
    const std::uint64_t open = ~(verdict.apart | verdict.pierce) & in_use;
    for (std::uint64_t rest = open; rest != 0; rest &= rest - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(rest));
        decide(pairs_[i], batched(i, 0), batched(i, 3));
    }
}

triangle3 mesh_pair_sieve::batched(std::size_t i, std::size_t first_corner) const {
    triangle3 t;
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis)
            t[k][axis] = batch_.at[first_corner + k][axis][i];
    return t;
}

void mesh_pair_sieve::decide(const face_numbers& pair, const triangle3& a, const triangle3& b) {
    ++output_.exact_pairs;
    const triangle_contact common = intersect(a, b, &output_.predicates);
    if (common.kind == overlap::none) return;
    if (collinear(a[0], a[1], a[2], &output_.predicates) ||
        collinear(b[0], b[1], b[2], &output_.predicates))
        record(pair, pair_kind::degenerate);
    else if (common.kind == overlap::area)
        record(pair, pair_kind::overlap);
    else
        record(pair, common.crossing ? pair_kind::crossing : pair_kind::touching);
}

void mesh_pair_sieve::record(const face_numbers& pair, pair_kind kind) {
    const auto k = static_cast<std::size_t>(kind);
    if (!input_.kinds[k]) return;
    ++output_.counts[k];
    output_.pairs.push_back({pair.a, pair.b, kind});
}

}  // namespace tf::detail
