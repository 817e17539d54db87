#pragma once
/// \file
/// Nearness searches for many queries at once, in parallel.

#include <treeform/tree/answers.hpp>
#include <treeform/tree/detail/frame.hpp>
#include <treeform/tree/detail/morton_order.hpp>
#include <treeform/tree/nearness.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <ranges>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace treeform {

namespace detail {

/// Number of consecutive queries for one thread; the answer of each bounds the search of the next.
inline constexpr std::size_t queries_per_chunk = 256;

template <std::ranges::random_access_range Range>
[[nodiscard]] decltype(auto) element(const Range& range, std::size_t i) {
    return std::ranges::begin(range)[static_cast<std::ranges::range_difference_t<Range>>(i)];
}

/// An order in which queries that are near each other in space follow each other.
/// \throws std::invalid_argument naming the first query that is not finite or an empty box
template <std::size_t D, std::ranges::random_access_range Queries>
[[nodiscard]] std::vector<std::uint32_t> order_of_queries(const Queries& queries) {
    const auto count = static_cast<std::size_t>(std::ranges::size(queries));
    for (std::size_t i = 0; i < count; ++i)
        if (!is_finite(box_of_query<D>(element(queries, i))))
            throw std::invalid_argument("treeform::nearness: query " + std::to_string(i) +
                                        " is not finite, or an empty box");
    return morton_order<D>(count,
                           [&](std::size_t i) { return box_of_query<D>(element(queries, i)).min; });
}

/// The lists that `search(query)` returns, run in parallel and joined in the order of the queries.
template <std::size_t D, class Queries, class Search>
[[nodiscard]] auto lists_of(const Queries& queries, const Search& search) {
    using list = std::invoke_result_t<const Search&, std::size_t>;
    const std::vector<std::uint32_t> order = order_of_queries<D>(queries);
    std::vector<list> found(order.size());
    for_chunks(order.size(), queries_per_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t i = begin; i < end; ++i) found[order[i]] = search(order[i]);
               });
    answer_lists<typename list::value_type> lists;
    lists.begin.resize(found.size() + 1);
    for (std::size_t i = 0; i < found.size(); ++i)
        lists.begin[i + 1] = lists.begin[i] + found[i].size();
    lists.answers.reserve(lists.begin.back());
    for (list& one : found)
        lists.answers.insert(lists.answers.end(), std::move_iterator(one.begin()),
                             std::move_iterator(one.end()));
    return lists;
}

}  // namespace detail

/// [Q] `nearest` for each of `queries`, in their order; `distance_of(query, id)` also gets the
/// number of the query, and is called from several threads at once.
///
/// \throws std::invalid_argument as `nearest`, naming the query
/// \cost   O(Q) plus the searches, which run in parallel and in spatial order, so that each reuses
///         the cached nodes of the previous one, and its answer as the first bound
/// \same   on any number of threads; the same result as `nearest` for each query
template <any_tree Tree, std::ranges::random_access_range Queries, class DistanceOf>
[[nodiscard]] auto nearest_batch(const Tree& tree, const Queries& queries,
                                 const DistanceOf& distance_of, double radius = unlimited_radius,
                                 node_order order = node_order::depth_first) {
    using answer =
        std::remove_cvref_t<std::invoke_result_t<const DistanceOf&, std::size_t, std::uint32_t>>;
    const double squared = detail::squared_radius("treeform::nearest_batch", radius);
    const auto in_space = detail::order_of_queries<Tree::dimensions>(queries);
    std::vector<std::optional<neighbor<answer>>> found(in_space.size());
    const auto search = [&](std::size_t begin, std::size_t end, std::size_t) {
        std::optional<std::uint32_t> before;
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t query = in_space[i];
            const auto from_query = [&](std::uint32_t id) { return distance_of(query, id); };
            detail::nearest_one<answer> one(squared);
            if (before) one.offer(*before, from_query);
            detail::walk_near(
                tree, detail::box_of_query<Tree::dimensions>(detail::element(queries, query)),
                one.bound(), order, [&](std::uint32_t id) {
                    if (id != before) one.offer(id, from_query);
                    return one.bound();
                });
            if (one.best) before = one.best->id;
            found[query] = std::move(one.best);
        }
    };
    for_chunks(in_space.size(), detail::queries_per_chunk, search);
    return found;
}

/// [Q] lists: `k_nearest` for each of `queries`, in their order. See `nearest_batch`.
///
/// \throws std::invalid_argument as `nearest`
/// \cost   as `nearest_batch`
/// \same   on any number of threads; the same result as `k_nearest` for each query
template <any_tree Tree, std::ranges::random_access_range Queries, class DistanceOf>
[[nodiscard]] auto k_nearest_batch(const Tree& tree, const Queries& queries, std::size_t k,
                                   const DistanceOf& distance_of, double radius = unlimited_radius,
                                   node_order order = node_order::depth_first) {
    return detail::lists_of<Tree::dimensions>(queries, [&](std::size_t query) {
        return k_nearest(
            tree, detail::element(queries, query), k,
            [&](std::uint32_t id) { return distance_of(query, id); }, radius, order);
    });
}

/// [Q] lists: `all_within` for each of `queries`, in their order. See `nearest_batch`.
///
/// \throws std::invalid_argument as `all_within`
/// \cost   as `nearest_batch`
/// \same   on any number of threads; the same result as `all_within` for each query
template <any_tree Tree, std::ranges::random_access_range Queries, class DistanceOf>
[[nodiscard]] auto all_within_batch(const Tree& tree, const Queries& queries, double radius,
                                    const DistanceOf& distance_of) {
    return detail::lists_of<Tree::dimensions>(queries, [&](std::size_t query) {
        return all_within(tree, detail::element(queries, query), radius,
                          [&](std::uint32_t id) { return distance_of(query, id); });
    });
}

}  // namespace treeform
