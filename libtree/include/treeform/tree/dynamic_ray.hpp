#pragma once
/// \file
/// Rays through a `dynamic_tree`: as dynamic_search.hpp says.

#include <treeform/tree/dynamic_tree.hpp>
#include <treeform/tree/ray.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace treeform {

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

}  // namespace treeform
