#include <libmesh/intersect/pair_decider.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace treeform::detail::intersect {
namespace {

/// Whether no coordinate is NaN or larger in magnitude than `limit`.
bool within(const triangle3& t, double limit) {
    unsigned all = 1;  // not a bool: nothing is to branch here
    for (const point3& p : t)
        for (std::size_t k = 0; k < 3; ++k) all &= static_cast<unsigned>(std::abs(p[k]) <= limit);
    return all != 0;
}

}  // namespace

void pair_decider::add(const face_numbers& pair, const triangle3& a, const triangle3& b) {
    constexpr double limit = largest_filtered_coordinate;
    if (!(within(a, limit) && within(b, limit))) {
        constexpr double largest = std::numeric_limits<double>::max();
        const bool good_a = within(a, largest);
        const bool good_b = within(b, largest);
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
    if (++count_ == pair_batch<6>::capacity) finish();
}

void pair_decider::finish() {
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

triangle3 pair_decider::batched(std::size_t i, std::size_t first_corner) const {
    triangle3 t;
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis)
            t[k][axis] = batch_.at[first_corner + k][axis][i];
    return t;
}

void pair_decider::decide(const face_numbers& pair, const triangle3& a, const triangle3& b) {
    ++output_.exact_pairs;
    const triangle_contact common = treeform::intersect(a, b, &output_.predicates);
    if (common.kind == overlap::none) return;
    if (collinear(a[0], a[1], a[2], &output_.predicates) ||
        collinear(b[0], b[1], b[2], &output_.predicates))
        record(pair, pair_kind::degenerate);
    else if (common.kind == overlap::area)
        record(pair, pair_kind::overlap);
    else
        record(pair, common.crossing ? pair_kind::crossing : pair_kind::touching);
}

void pair_decider::record(const face_numbers& pair, pair_kind kind) {
    const auto k = static_cast<std::size_t>(kind);
    if (!kinds_.contains(kind)) return;
    ++output_.counts[k];
    output_.pairs.push_back({pair.a, pair.b, kind});
}

}  // namespace treeform::detail::intersect
