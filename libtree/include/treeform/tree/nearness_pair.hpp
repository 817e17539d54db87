#pragma once
/// \file
/// Nearness searches of two trees of any kind: the nearest pair of primitives, one of each tree,
/// and the k nearest pairs.

#include <treeform/tree/answers.hpp>
#include <treeform/tree/detail/near_pair_walk.hpp>
#include <treeform/tree/detail/nearest_k.hpp>
#include <treeform/tree/detail/squared_radius.hpp>
#include <treeform/tree/detail/trees_side.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace treeform {

namespace detail {

/// Adds the nearest pairs of two trees to `found`.
template <bool has_empty_slots, std::size_t D, class Kept, class DistanceOf>
[[nodiscard]] Kept nearest_pairs(const transformed<D>& a, const transformed<D>& b, std::size_t k,
                                 Kept found, const DistanceOf& distance_of) {
    const std::uint32_t* const ids_a = a.original().ids().data();
    const std::uint32_t* const ids_b = b.original().ids().data();
    const auto visit = [&](const block_pair& blocks, Kept& mine, double limit) {
        float bound = blocks.bound_of(std::min(limit, mine.bound()));
        for (std::uint32_t i = 0; i < 8; ++i)
            for (std::uint32_t j = 0; j < 8; ++j) {
                if (!blocks.within(i, j, bound)) continue;
                const std::uint32_t of_a = ids_a[blocks.a * 8 + i];
                const std::uint32_t of_b = ids_b[blocks.b * 8 + j];
                if constexpr (has_empty_slots)
                    if (of_a == no_primitive || of_b == no_primitive) continue;
                mine.offer({{of_a, of_b}, distance_of(of_a, of_b)});
                if (mine.done()) return;
                bound = blocks.bound_of(std::min(limit, mine.bound()));
            }
    };
    if (a.original().empty() || b.original().empty()) return found;
    pair_walk<D> walk(a, b, 1.0);
    return walk_pairs(
        walk, std::move(found), visit, [&](const Kept& all) { return Kept(k, all.bound()); },
        [](Kept& all, Kept& part) {
            for (auto& one : part.sorted()) all.offer(std::move(one));
        });
}

/// The same for the parts of two trees of trees: pairs of parts one after the other, the nearest
/// first, so that the result does not depend on timing.
template <std::size_t D, class A, class B, class Kept, class DistanceOf>
[[nodiscard]] Kept nearest_pairs_of_parts(const transformed<D, A>& first,
                                          const transformed<D, B>& second, std::size_t k,
                                          Kept found, const DistanceOf& distance_of) {
    const trees_side<D, A> a(first);
    const trees_side<D, B> b(second);
    const transformed<D> top_a = a.top(), top_b = b.top();
    const auto visit = [&](const block_pair& blocks) {
        for (std::uint32_t i = 0; i < 8; ++i)
            for (std::uint32_t j = 0; j < 8; ++j) {
                if (found.done() || !blocks.within(i, j, blocks.bound_of(found.bound()))) continue;
                const std::uint32_t x = top_a.original().ids()[blocks.a * 8 + i];
                const std::uint32_t y = top_b.original().ids()[blocks.b * 8 + j];
                found = nearest_pairs<true>(a.part(x), b.part(y), k, std::move(found), distance_of);
            }
        return found.bound();
    };
    const auto stop = [&] { return found.done(); };
    if (top_a.original().empty() || top_b.original().empty()) return found;
    pair_walk<D> walk(top_a, top_b, 1.0);
    walk.begin(found.bound(), stop, visit);
    for (std::size_t chunk = 0; chunk < walk.chunks(); ++chunk)
        walk.visit(chunk, std::atomic<double>(found.bound()), stop, visit);
    return found;
}

}  // namespace detail

/// The k nearest pairs of a primitive of `first` and one of `second`, ascending by distance, then
/// by ids; fewer if fewer are within `radius` (not squared, inclusive). Each is a `neighbor` whose
/// id is an `id_pair`.
///
/// `distance_of(a, b)` returns the squared distance of two primitives, as in `nearest`. It is
/// called from several threads at once, at most once for each pair. Either tree may be
/// `transformed`; `distance_of` must then return distances of the moved primitives.
///
/// Pairs are only skipped if their boxes prove that they are further apart than k pairs found so
/// far. The search ends early only at distance zero: if more than k pairs touch, k of them are
/// returned, the same in every run.
///
/// \throws std::invalid_argument if the radius is negative or NaN
/// \cost   O(log N) nodes if one pair is clearly the nearest; more if large parts of both are about
///         equally near
/// \same   on any number of threads
/// \source Sajovic, Knez and Korez, tf::tree, section III-D, without its upper bound from boxes,
///         which does not hold for primitives smaller than their boxes; the larger box is opened,
///         eight children at a time
template <any_tree_or_transformed A, any_tree_or_transformed B, class DistanceOf>
[[nodiscard]] auto k_nearest_pairs(const A& first, const B& second, std::size_t k,
                                   const DistanceOf& distance_of,
                                   double radius = std::numeric_limits<double>::infinity()) {
    using answer =
        std::remove_cvref_t<std::invoke_result_t<const DistanceOf&, std::uint32_t, std::uint32_t>>;
    const transformed a(first);
    const transformed b(second);
    detail::nearest_k<neighbor<answer, id_pair>> found(
        k, detail::squared_radius("treeform::k_nearest_pairs", radius));
    if (k == 0) return found.sorted();
    if constexpr (tree_or_transformed<A> && tree_or_transformed<B>)
        found = detail::nearest_pairs<false>(a, b, k, std::move(found), distance_of);
    else
        found = detail::nearest_pairs_of_parts(a, b, k, std::move(found), distance_of);
    return std::move(found.sorted());
}

/// The nearest pair; of equally near pairs, the one with the lowest ids; of pairs at distance zero,
/// any, but the same in every run. None if a tree is empty or all pairs are beyond the radius. See
/// `k_nearest_pairs`.
template <any_tree_or_transformed A, any_tree_or_transformed B, class DistanceOf>
[[nodiscard]] auto nearest_pair(const A& a, const B& b, const DistanceOf& distance_of,
                                double radius = std::numeric_limits<double>::infinity()) {
    auto pairs = k_nearest_pairs(a, b, 1, distance_of, radius);
    return pairs.empty() ? std::nullopt : std::optional(std::move(pairs[0]));
}

}  // namespace treeform
