#pragma once
/// \file
/// Nearness over a `dynamic_tree`, and nearest pairs of two: as dynamic_search.hpp says.

#include <treeform/tree/dynamic_search.hpp>
#include <treeform/tree/dynamic_tree.hpp>
#include <treeform/tree/nearness_batch.hpp>
#include <treeform/tree/nearness_pair.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <ranges>
#include <type_traits>
#include <utility>
#include <vector>

namespace treeform {

template <std::size_t D, nearness_query<D> Query, class Visit>
requires std::is_invocable_r_v<double, const Visit&, std::uint32_t>
void visit_near(const dynamic_tree<D>& trees, const Query& query, const Visit& visit,
                const nearness_options& options = {}) {
    // A query is refused even when there are no trees: here by one that is empty.
    double bound = detail::squared_radius("treeform::visit_near", options.radius);
    const aabb<double, D> box = detail::box_of_query<D>(query);
    detail::approach<D>(tree<D>{}, box, bound, {}, [&](std::uint32_t) { return bound; });
    for (const tree<D>* one : trees.trees())
        detail::approach<D>(*one, box, bound, options.strategy, [&](std::uint32_t id) {
            if (id != detail::no_primitive) bound = visit(id);
            return bound;
        });
}

template <std::size_t D, nearness_query<D> Query, class DistanceOf>
[[nodiscard]] auto nearest(const dynamic_tree<D>& trees, const Query& query,
                           const DistanceOf& distance_of, const nearness_options& options = {}) {
    using answer = std::remove_cvref_t<std::invoke_result_t<const DistanceOf&, std::uint32_t>>;
    detail::nearest_one<answer> one(detail::squared_radius("treeform::nearest", options.radius));
    visit_near(
        trees, query,
        [&](std::uint32_t id) {
            one.offer(id, distance_of);
            return one.bound();
        },
        options);
    return one.best;
}

template <std::size_t D, nearness_query<D> Query, class DistanceOf>
[[nodiscard]] auto k_nearest(const dynamic_tree<D>& trees, const Query& query, std::size_t k,
                             const DistanceOf& distance_of, const nearness_options& options = {}) {
    using answer = std::remove_cvref_t<std::invoke_result_t<const DistanceOf&, std::uint32_t>>;
    detail::nearest_k<neighbor<answer>> found(
        std::min(k, trees.size()), detail::squared_radius("treeform::k_nearest", options.radius));
    visit_near(
        trees, query,
        [&](std::uint32_t id) {
            found.offer({id, distance_of(id)});
            return found.bound();
        },
        options);
    return std::move(found.sorted());
}

template <std::size_t D, nearness_query<D> Query, class DistanceOf>
[[nodiscard]] auto all_within(const dynamic_tree<D>& trees, const Query& query, double radius,
                              const DistanceOf& distance_of,
                              const nearness_strategy& strategy = {}) {
    using answer = std::remove_cvref_t<std::invoke_result_t<const DistanceOf&, std::uint32_t>>;
    const double bound = detail::squared_radius("treeform::all_within", radius);
    std::vector<neighbor<answer>> found;
    visit_near(trees, query,
               [&](std::uint32_t id) {
                   neighbor<answer> one{id, distance_of(id)};
                   if (one.squared_distance() <= bound) found.push_back(std::move(one));
                   return bound;
               },
               {radius, strategy});
    std::sort(found.begin(), found.end(),
              [](const auto& a, const auto& b) { return nearer(a, b); });
    return found;
}

template <std::size_t D, std::ranges::random_access_range Queries, class DistanceOf>
[[nodiscard]] auto nearest_batch(const dynamic_tree<D>& trees, const Queries& queries,
                                 const DistanceOf& distance_of,
                                 const nearness_options& options = {}) {
    using answer =
        std::remove_cvref_t<std::invoke_result_t<const DistanceOf&, std::size_t, std::uint32_t>>;
    const std::vector<std::uint32_t> order = detail::order_of_queries<D>(queries);
    std::vector<std::optional<neighbor<answer>>> found(order.size());
    for_chunks(order.size(), detail::queries_per_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t i = begin; i < end; ++i)
                       found[order[i]] = nearest(
                           trees, detail::element(queries, order[i]),
                           [&](std::uint32_t id) { return distance_of(order[i], id); }, options);
               });
    return found;
}

template <std::size_t D, std::ranges::random_access_range Queries, class DistanceOf>
[[nodiscard]] auto k_nearest_batch(const dynamic_tree<D>& trees, const Queries& queries,
                                   std::size_t k, const DistanceOf& distance_of,
                                   const nearness_options& options = {}) {
    return detail::lists_of<D>(queries, [&](std::size_t query) {
        return k_nearest(
            trees, detail::element(queries, query), k,
            [&](std::uint32_t id) { return distance_of(query, id); }, options);
    });
}

template <std::size_t D, std::ranges::random_access_range Queries, class DistanceOf>
[[nodiscard]] auto all_within_batch(const dynamic_tree<D>& trees, const Queries& queries,
                                    double radius, const DistanceOf& distance_of) {
    return detail::lists_of<D>(queries, [&](std::size_t query) {
        return all_within(trees, detail::element(queries, query), radius,
                          [&](std::uint32_t id) { return distance_of(query, id); });
    });
}

namespace detail {

/// What was said about a pair of primitives; a pair with an empty slot is at no distance.
template <class Answer>
struct said_of_pair {
    double squared_distance = std::numeric_limits<double>::quiet_NaN();
    std::optional<Answer> answer{};
};

}  // namespace detail

template <class A, class B, class DistanceOf>
requires detail::with_parts<A, B>
[[nodiscard]] auto k_nearest_pairs(const A& a, const B& b, std::size_t k,
                                   const DistanceOf& distance_of,
                                   double radius = std::numeric_limits<double>::infinity()) {
    using answer =
        std::remove_cvref_t<std::invoke_result_t<const DistanceOf&, std::uint32_t, std::uint32_t>>;
    constexpr std::size_t D = A::dimensions;
    detail::nearest_k<near_pair<answer>> found(
        k, detail::squared_radius("treeform::k_nearest_pairs", radius));
    const auto of_present = [&](std::uint32_t x, std::uint32_t y) {
        detail::said_of_pair<answer> said;
        if (x == detail::no_primitive || y == detail::no_primitive) return said;
        said.answer = distance_of(x, y);
        said.squared_distance = squared_distance_of(*said.answer);
        return said;
    };
    const tree_parts<D> first(a), second(b);
    for (const transformed<D>& x : first.parts())
        for (const transformed<D>& y : second.parts()) {
            if (found.done()) break;
            const double enough = std::sqrt(found.bound()) * (1.0 + 0x1p-50) + 1e-300;
            for (auto& one : k_nearest_pairs(x, y, k, of_present, std::min(radius, enough)))
                found.offer({one.a, one.b, std::move(*one.answer.answer)});
        }
    return std::move(found.sorted());
}

template <class A, class B, class DistanceOf>
requires detail::with_parts<A, B>
[[nodiscard]] auto nearest_pair(const A& a, const B& b, const DistanceOf& distance_of,
                                double radius = std::numeric_limits<double>::infinity()) {
    auto pairs = k_nearest_pairs(a, b, 1, distance_of, radius);
    return pairs.empty() ? std::nullopt : std::optional(std::move(pairs[0]));
}

}  // namespace treeform
