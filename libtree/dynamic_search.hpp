#pragma once
/// \file
/// The searches of libtree over a `dynamic_tree`: the same names, the same answers as over a tree
/// that has just been built. What the functions take and promise is said where they are declared
/// for `tree`; here stands what differs.
///
/// Primitives are ids of the dynamic tree. Where a search hands out in an order of its own, it
/// goes through the trees one by one, each in its leaf order. No search may run during an update.

#include <libtree/dynamic_tree.hpp>
#include <libtree/nearness_batch.hpp>
#include <libtree/nearness_pair.hpp>
#include <libtree/ray.hpp>
#include <libtree/search.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <ranges>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace tf {

// By a box or a check.

template <std::size_t D, tree_query<D> Query, class Apply>
search_statistics search(const dynamic_tree<D>& trees, const Query& query, const Apply& apply) {
    search_statistics seen;
    bool stopped = false;
    for (const tree<D>* one : trees.trees()) {
        if (stopped) break;
        seen += search(*one, query, [&](std::uint32_t id) {
            return stopped = id != detail::no_primitive && detail::asks_to_stop(apply, id);
        });
    }
    return seen;
}

template <std::size_t D, tree_query<D> Query, class Apply>
search_statistics search_broad(const dynamic_tree<D>& trees, const Query& query,
                               const Apply& apply) {
    search_statistics seen;
    bool stopped = false;
    for (const tree<D>* one : trees.trees()) {
        if (stopped) break;
        seen += search_broad(*one, query, [&](std::span<const std::uint32_t> block) {
            std::array<std::uint32_t, 8> ids;
            const auto last = std::copy_if(block.begin(), block.end(), ids.begin(),
                                           [](auto id) { return id != detail::no_primitive; });
            const auto count = static_cast<std::size_t>(last - ids.begin());
            return stopped =
                       count != 0 && detail::asks_to_stop(
                                         apply, std::span<const std::uint32_t>(ids.data(), count));
        });
    }
    return seen;
}

template <std::size_t D, tree_query<D> Query, class Accept>
[[nodiscard]] bool search_any(const dynamic_tree<D>& trees, const Query& query,
                              const Accept& accept) {
    bool found = false;
    search(trees, query, [&](std::uint32_t id) { return found = accept(id); });
    return found;
}

template <std::size_t D, tree_query<D> Query, class Accept>
[[nodiscard]] std::vector<std::uint32_t> search_all(const dynamic_tree<D>& trees,
                                                    const Query& query, const Accept& accept) {
    std::vector<std::uint32_t> found;
    search(trees, query, [&](std::uint32_t id) {
        if (accept(id)) found.push_back(id);
    });
    std::sort(found.begin(), found.end());
    return found;
}

template <std::size_t D, tree_query<D> Query>
[[nodiscard]] std::vector<std::uint32_t> search_all(const dynamic_tree<D>& trees,
                                                    const Query& query) {
    return search_all(trees, query, [](std::uint32_t) { return true; });
}

// Pairs.

/// A side of a search for pairs: one tree, or those of a dynamic tree; as they are, or moved:
/// `search<State>(tree_parts{trees, map}, other, apply)`.
///
/// \pre    the tree outlives this and every search that takes it, and is not updated meanwhile
/// \throws std::invalid_argument when an entry of `by` is NaN or infinite
template <std::size_t D>
class tree_parts {
  public:
    static constexpr std::size_t dimensions = D;

    tree_parts(const dynamic_tree<D>& trees, const transform<D>& by = {}) {  // NOLINT: implicit
        for (const tree<D>* one : trees.trees()) parts_.emplace_back(*one, by);
    }
    tree_parts(const tree<D>& one) : parts_{one} {}         // NOLINT: implicit
    tree_parts(const transformed<D>& one) : parts_{one} {}  // NOLINT: implicit

    [[nodiscard]] std::span<const transformed<D>> parts() const { return parts_; }

  private:
    std::vector<transformed<D>> parts_;
};

namespace detail {

template <class T>
inline constexpr bool is_of_parts = false;
template <std::size_t D>
inline constexpr bool is_of_parts<dynamic_tree<D>> = true;
template <std::size_t D>
inline constexpr bool is_of_parts<tree_parts<D>> = true;

/// What the searches for pairs below take, beside those of two trees.
template <class A, class B>
concept with_parts = (is_of_parts<A> && (is_of_parts<B> || is_placed_tree<B>)) ||
                     (is_placed_tree<A> && is_of_parts<B>);

/// The searches of several trees as one, their chunks one after the other. `visit` gets blocks
/// with the primitives [N] that the places of each side stand for.
template <std::size_t D>
class joined_search {
  public:
    explicit joined_search(const dynamic_tree<D>& trees) {
        const std::vector<const tree<D>*> parts = trees.trees();
        for (std::size_t i = 0; i < parts.size(); ++i) {
            add(self_search<D>(*parts[i]), *parts[i], *parts[i]);
            for (std::size_t j = i + 1; j < parts.size(); ++j)
                add(pair_search<D>(*parts[i], *parts[j]), *parts[i], *parts[j]);
        }
    }
    joined_search(const tree_parts<D>& a, const tree_parts<D>& b) {
        for (const transformed<D>& x : a.parts())
            for (const transformed<D>& y : b.parts())
                add(pair_search<D>(x, y), x.original(), y.original());
    }

    [[nodiscard]] std::size_t chunks() const { return chunks_; }

    template <class Visit>
    search_statistics visit(std::size_t chunk, const Visit& visit) const {
        const auto above =
            std::upper_bound(pieces_.begin(), pieces_.end(), chunk,
                             [](std::size_t c, const piece& p) { return c < p.first_chunk; });
        const piece& at = *(above - 1);
        const auto on_block = [&](const candidate_block& block) {
            return visit(block, at.ids_a, at.ids_b);
        };
        return std::visit(
            [&](const auto& search) { return search.visit(chunk - at.first_chunk, on_block); },
            at.search);
    }

  private:
    struct piece {
        std::size_t first_chunk;
        std::variant<self_search<D>, pair_search<D>> search;
        const std::uint32_t* ids_a;
        const std::uint32_t* ids_b;
    };

    template <class Search>
    void add(Search search, const tree<D>& a, const tree<D>& b) {
        const std::size_t count = search.chunks();
        if (count == 0) return;
        pieces_.push_back({chunks_, std::move(search), a.ids().data(), b.ids().data()});
        chunks_ += count;
    }

    std::size_t chunks_ = 0;
    std::vector<piece> pieces_;
};

/// Calls `apply(a, b)` for the pairs of a block, until it is true.
inline constexpr auto any_of_block = [](const candidate_block& block, const std::uint32_t* ids_a,
                                        const std::uint32_t* ids_b, const auto& apply) {
    for (std::size_t i = 0; i < block.first.size(); ++i) {
        const std::uint32_t a = ids_a[block.first[i]], b = ids_b[block.second[i]];
        if (a != no_primitive && b != no_primitive && apply(a, b)) return true;
    }
    return false;
};

template <class State, std::size_t D, class Apply>
[[nodiscard]] std::vector<State> pair_states(const joined_search<D>& search, const Apply& apply) {
    return search_states<State>(
        search, [&](State& state, const candidate_block& block, const std::uint32_t* ids_a,
                    const std::uint32_t* ids_b) {
            return any_of_block(block, ids_a, ids_b, [&](std::uint32_t a, std::uint32_t b) {
                return asks_to_stop(apply, state, a, b);
            });
        });
}

/// Whether `accept(a, b)` for some pair: the tests stop on all threads once one is known.
template <std::size_t D, class Accept>
[[nodiscard]] bool any_pair(const joined_search<D>& search, const Accept& accept) {
    std::atomic<bool> found{false};
    for_chunks(search.chunks(), 1, [&](std::size_t chunk, std::size_t, std::size_t) {
        if (found.load(std::memory_order_relaxed)) return;
        search.visit(chunk, [&](const candidate_block& block, const std::uint32_t* ids_a,
                                const std::uint32_t* ids_b) {
            if (found.load(std::memory_order_relaxed)) return false;
            if (any_of_block(block, ids_a, ids_b, accept))
                found.store(true, std::memory_order_relaxed);
            return !found.load(std::memory_order_relaxed);
        });
    });
    return found.load();
}

template <std::size_t D, class Accept>
[[nodiscard]] std::vector<id_pair> all_pairs(const joined_search<D>& search, bool ordered,
                                             const Accept& accept) {
    using pairs = std::vector<id_pair>;
    pairs all =
        joined(pair_states<pairs>(search, [&](pairs& found, std::uint32_t a, std::uint32_t b) {
            if (ordered && b < a) std::swap(a, b);
            if (accept(a, b)) found.emplace_back(a, b);
        }));
    std::sort(all.begin(), all.end());
    return all;
}

inline constexpr auto every_pair = [](std::uint32_t, std::uint32_t) { return true; };

}  // namespace detail

template <class State, std::size_t D, class Apply>
[[nodiscard]] std::vector<State> search_self(const dynamic_tree<D>& trees, const Apply& apply) {
    return detail::pair_states<State>(detail::joined_search<D>(trees), apply);
}
template <std::size_t D, class Accept>
[[nodiscard]] bool search_self_any(const dynamic_tree<D>& trees, const Accept& accept) {
    return detail::any_pair(detail::joined_search<D>(trees), accept);
}
template <std::size_t D, class Accept>
[[nodiscard]] std::vector<id_pair> search_self_all(const dynamic_tree<D>& trees,
                                                   const Accept& accept) {
    return detail::all_pairs(detail::joined_search<D>(trees), true, accept);
}
template <std::size_t D>
[[nodiscard]] std::vector<id_pair> search_self_all(const dynamic_tree<D>& trees) {
    return search_self_all(trees, detail::every_pair);
}

template <class State, class A, class B, class Apply>
requires detail::with_parts<A, B>
[[nodiscard]] std::vector<State> search(const A& a, const B& b, const Apply& apply) {
    return detail::pair_states<State>(detail::joined_search<A::dimensions>(a, b), apply);
}
template <class A, class B, class Accept>
requires detail::with_parts<A, B>
[[nodiscard]] bool search_any(const A& a, const B& b, const Accept& accept) {
    return detail::any_pair(detail::joined_search<A::dimensions>(a, b), accept);
}
template <class A, class B, class Accept>
requires detail::with_parts<A, B>
[[nodiscard]] std::vector<id_pair> search_all(const A& a, const B& b, const Accept& accept) {
    return detail::all_pairs(detail::joined_search<A::dimensions>(a, b), false, accept);
}
template <class A, class B>
requires detail::with_parts<A, B>
[[nodiscard]] std::vector<id_pair> search_all(const A& a, const B& b) {
    return search_all(a, b, detail::every_pair);
}

// What is near.

template <std::size_t D, nearness_query<D> Query, class Visit>
requires std::is_invocable_r_v<double, const Visit&, std::uint32_t>
void visit_near(const dynamic_tree<D>& trees, const Query& query, const Visit& visit,
                const nearness_options& options = {}) {
    // A query is refused even when there are no trees: here by one that is empty.
    double bound = detail::squared_radius("tf::visit_near", options.radius);
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
    detail::nearest_one<answer> one(detail::squared_radius("tf::nearest", options.radius));
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
        std::min(k, trees.size()), detail::squared_radius("tf::k_nearest", options.radius));
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
    const double bound = detail::squared_radius("tf::all_within", radius);
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
        k, detail::squared_radius("tf::k_nearest_pairs", radius));
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

// Rays.

namespace detail {

/// Throws as every search along `ray` does, also where there are no trees to search.
template <std::size_t D>
void refuse_unsound(const ray<double, D>& ray) {
    trace<D>(tree<D>{}, ray, [&](std::uint32_t) { return ray.t_max; });
}

}  // namespace detail

template <std::floating_point T, std::size_t D, class Visit>
requires std::is_invocable_r_v<double, const Visit&, std::uint32_t>
void visit_along(const dynamic_tree<D>& trees, const ray<T, D>& ray, const Visit& visit) {
    auto rest = detail::in_double(ray);
    detail::refuse_unsound(rest);
    for (const tree<D>* one : trees.trees()) {
        if (rest.t_max == -std::numeric_limits<double>::infinity()) break;
        detail::trace<D>(*one, rest, [&](std::uint32_t id) {
            if (id != detail::no_primitive) rest.t_max = visit(id);
            return rest.t_max;
        });
    }
}

template <std::floating_point T, std::size_t D, class HitOf>
[[nodiscard]] auto first_hit(const dynamic_tree<D>& trees, const ray<T, D>& ray,
                             const HitOf& hit_of) {
    std::optional<ray_hit<detail::hit_type<HitOf>>> best;
    auto rest = detail::in_double(ray);
    detail::refuse_unsound(rest);
    for (const tree<D>* one : trees.trees()) {
        auto hit = first_hit(*one, rest, hit_of);
        if (!hit) continue;
        const double t = detail::parameter_of(hit->hit);
        if (best && t == rest.t_max && best->id < hit->id) continue;
        rest.t_max = t;
        best = std::move(hit);
    }
    return best;
}

template <std::floating_point T, std::size_t D, class HitOf>
[[nodiscard]] auto all_hits(const dynamic_tree<D>& trees, const ray<T, D>& ray,
                            const HitOf& hit_of) {
    detail::refuse_unsound(detail::in_double(ray));
    std::vector<ray_hit<detail::hit_type<HitOf>>> hits;
    for (const tree<D>* one : trees.trees()) {
        auto more = all_hits(*one, ray, hit_of);
        hits.insert(hits.end(), std::move_iterator(more.begin()), std::move_iterator(more.end()));
    }
    std::sort(hits.begin(), hits.end(), [](const auto& a, const auto& b) {
        const double of_a = detail::parameter_of(a.hit);
        const double of_b = detail::parameter_of(b.hit);
        return of_a != of_b ? of_a < of_b : a.id < b.id;
    });
    return hits;
}

template <std::floating_point T, std::size_t D, class HitOf>
[[nodiscard]] bool any_hit(const dynamic_tree<D>& trees, const ray<T, D>& ray,
                           const HitOf& hit_of) {
    detail::refuse_unsound(detail::in_double(ray));
    for (const tree<D>* one : trees.trees())
        if (any_hit(*one, ray, hit_of)) return true;
    return false;
}

}  // namespace tf
