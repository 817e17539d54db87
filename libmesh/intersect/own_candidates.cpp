#include <libmesh/intersect/classify_pair.hpp>
#include <libmesh/intersect/own_candidates.hpp>

#include <algorithm>
#include <array>

namespace treeform::detail::intersect {
namespace {

/// The corners of a pair in the order of the filter of its class.
template <candidate_classes::name Class>
std::array<std::uint32_t, filtered_corners<Class>> corners_of(const numbered_face& a,
                                                              const numbered_face& b,
                                                              const candidate& by) {
    if constexpr (Class == candidate_classes::edge)
        return {a[by.corner_a<1>()], a[by.corner_a<2>()], a[by.corner_a<0>()], b[by.corner_b<0>()]};
    else if constexpr (Class == candidate_classes::corner)
        return {a[by.corner_a<0>()], a[by.corner_a<1>()], a[by.corner_a<2>()], b[by.corner_b<1>()],
                b[by.corner_b<2>()]};
    else
        return {a[0], a[1], a[2], b[0], b[1], b[2]};
}

}  // namespace

void own_candidates::offer(const candidate_block& block, narrow_phase<own_candidates>& phase) {
    block_ = own_.options->between || own_.options->within ? wanted(block) : block;
    sort_by_class(block_, own_.faces.data(), classes_);
    offer_class<candidate_classes::edge>(phase);
    offer_class<candidate_classes::corner>(phase);
    offer_class<candidate_classes::separate>(phase);
    decide_class(candidate_classes::other, phase);
}

template <candidate_classes::name Class>
void own_candidates::offer_class(narrow_phase<own_candidates>& phase) {
    if (!own_.filtered) return decide_class(Class, phase);
    const auto& list = classes_.list[Class];
    const std::size_t total = classes_.count[Class];
    const auto corners_at = [&](std::size_t i) {
        const face_numbers pair = places(list[i]);
        return corners_of<Class>(own_.faces[pair.a], own_.faces[pair.b], list[i]);
    };
    constexpr std::size_t ahead = 8;  // corners are anywhere in memory
    for (std::size_t begin = 0; begin < total; begin += pair_batch::capacity) {
        const std::size_t count = std::min(pair_batch::capacity, total - begin);
        for (std::size_t i = 0; i < count; ++i) {
            if (begin + i + ahead < total)
                for (const std::uint32_t corner : corners_at(begin + i + ahead))
                    __builtin_prefetch(&own_.points[corner]);
            const auto corners = corners_at(begin + i);
            phase.put<Class>(i, places(list[begin + i]), [&](std::size_t k) -> const point3& {
                return own_.points[corners[k]];
            });
        }
        phase.filter<Class>(count);
    }
}

/// Those of a class without a filter.
void own_candidates::decide_class(candidate_classes::name which,
                                  narrow_phase<own_candidates>& phase) const {
    for (std::size_t i = 0; i < classes_.count[which]; ++i) {
        const face_numbers pair = places(classes_.list[which][i]);
        phase.decide(pair, [&](predicate_counters& counters) { return classify(pair, counters); });
    }
}

/// The candidates that `between` and `within` leave.
candidate_block own_candidates::wanted(const candidate_block& block) {
    const face_pair_options& options = *own_.options;
    std::size_t count = 0;
    for (std::size_t i = 0; i < block.first.size(); ++i) {
        const std::uint32_t a = block.first[i];
        const std::uint32_t b = block.second[i];
        const bool same = options.component_of_face[own_.faces[a].back()] ==
                          options.component_of_face[own_.faces[b].back()];
        if ((options.between && same) || (options.within && !same)) continue;
        wanted_first_[count] = a;
        wanted_second_[count++] = b;
    }
    return {{wanted_first_.data(), count}, {wanted_second_.data(), count}};
}

face_numbers own_candidates::faces(const face_numbers& places) const {
    const auto [low, high] = std::minmax(own_.faces[places.a].back(), own_.faces[places.b].back());
    return {low, high};
}

std::optional<pair_kind> own_candidates::classify(const face_numbers& places,
                                                  predicate_counters& counters) const {
    const auto plain = [](const numbered_face& f) { return face{f[0], f[1], f[2]}; };
    return classify_pair(own_.points, plain(own_.faces[places.a]), plain(own_.faces[places.b]),
                         counters);
}

}  // namespace treeform::detail::intersect
