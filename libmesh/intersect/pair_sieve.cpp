#include <libmesh/intersect/classify_pair.hpp>
#include <libmesh/intersect/pair_sieve.hpp>

#include <algorithm>
#include <bit>

namespace treeform::detail::intersect {
namespace {

constexpr std::size_t vector_pairs = 8;  // at most in a vector of the filter

// The corners of a pair in the order of each filter. Lambdas, so that the loops inline them.
constexpr auto edge_corners = [](const numbered_face& a, const numbered_face& b,
                                 const candidate& pair) {
    return std::array{a[pair.corner_a<1>()], a[pair.corner_a<2>()], a[pair.corner_a<0>()],
                      b[pair.corner_b<0>()]};
};
constexpr auto corner_corners = [](const numbered_face& a, const numbered_face& b,
                                   const candidate& pair) {
    return std::array{a[pair.corner_a<0>()], a[pair.corner_a<1>()], a[pair.corner_a<2>()],
                      b[pair.corner_b<1>()], b[pair.corner_b<2>()]};
};
constexpr auto separate_corners = [](const numbered_face& a, const numbered_face& b,
                                     const candidate&) {
    return std::array{a[0], a[1], a[2], b[0], b[1], b[2]};
};

}  // namespace

void pair_sieve::add(const candidate_block& block) {
    output_.box_pairs += block.first.size();
    block_ = input_.options->component_of_face.empty() ? block : wanted(block);
    sort_by_class(block_, input_.faces.data(), classes_);
    filter_class<4>(candidate_classes::edge, edge_corners, filter_edge_pairs);
    filter_class<5>(candidate_classes::corner, corner_corners, filter_corner_pairs);
    filter_class<6>(candidate_classes::separate, separate_corners, filter_separate_pairs);
    for (std::size_t i = 0; i < classes_.count[candidate_classes::other]; ++i)
        decide(classes_.list[candidate_classes::other][i]);
}

/// The candidates that `between` and `within` leave.
candidate_block pair_sieve::wanted(const candidate_block& block) {
    const self_intersection_options& options = *input_.options;
    std::size_t count = 0;
    for (std::size_t i = 0; i < block.first.size(); ++i) {
        const std::uint32_t a = block.first[i];
        const std::uint32_t b = block.second[i];
        const bool same = options.component_of_face[input_.faces[a].back()] ==
                          options.component_of_face[input_.faces[b].back()];
        if ((options.between && same) || (options.within && !same)) continue;
        wanted_first_[count] = a;
        wanted_second_[count++] = b;
    }
    return {{wanted_first_.data(), count}, {wanted_second_.data(), count}};
}

template <std::size_t Corners, class CornersOf, class Filter>
void pair_sieve::filter_class(std::size_t which, const CornersOf& corners_of,
                              const Filter& filter) {
    using batch_type = pair_batch<Corners>;
    const auto& list = classes_.list[which];
    const std::size_t total = classes_.count[which];
    if (!input_.filtered) {
        for (std::size_t i = 0; i < total; ++i) decide(list[i]);
        return;
    }
    batch_type batch;
    for (std::size_t begin = 0; begin < total; begin += batch_type::capacity) {
        const std::size_t count = std::min(batch_type::capacity, total - begin);
        for (std::size_t i = 0; i < count; ++i) {
            const candidate& pair = list[begin + i];
            const auto corners = corners_of(face_a(pair), face_b(pair), pair);
            for (std::size_t k = 0; k < Corners; ++k) {
                const point3& p = input_.points[corners[k]];
                batch.at[k][0][i] = p.x;
                batch.at[k][1][i] = p.y;
                batch.at[k][2][i] = p.z;
            }
        }
        for (std::size_t i = count; i % vector_pairs != 0; ++i)  // the last vector, to its end
            for (auto& corner : batch.at)
                for (auto& axis : corner) axis[i] = axis[0];
        const batch_verdict verdict = filter(batch, count);
        const std::uint64_t in_use = ~std::uint64_t{0} >> (batch_type::capacity - count);
        for (std::uint64_t rest = verdict.pierce & in_use; rest != 0; rest &= rest - 1)
            record(list[begin + static_cast<std::size_t>(std::countr_zero(rest))],
                   Corners == 6 ? pair_kind::crossing : pair_kind::pierce);
        const std::uint64_t open = ~(verdict.apart | verdict.pierce) & in_use;
        for (std::uint64_t rest = open; rest != 0; rest &= rest - 1)
            decide(list[begin + static_cast<std::size_t>(std::countr_zero(rest))]);
    }
}

const numbered_face& pair_sieve::face_a(const candidate& pair) const {
    return input_.faces[block_.first[pair.index()]];
}
const numbered_face& pair_sieve::face_b(const candidate& pair) const {
    return input_.faces[block_.second[pair.index()]];
}

void pair_sieve::decide(const candidate& pair) {
    ++output_.exact_pairs;
    const auto plain = [](const numbered_face& f) { return face{f[0], f[1], f[2]}; };
    if (const auto kind = classify_pair(input_.points, plain(face_a(pair)), plain(face_b(pair)),
                                        output_.predicates))
        record(pair, *kind);
}

void pair_sieve::record(const candidate& pair, pair_kind kind) {
    const auto k = static_cast<std::size_t>(kind);
    if (!input_.options->kinds.contains(kind)) return;
    const auto [low, high] = std::minmax(face_a(pair).back(), face_b(pair).back());
    ++output_.counts[k];
    output_.pairs.push_back({low, high, kind});
}

}  // namespace treeform::detail::intersect
