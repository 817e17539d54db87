#pragma once
/// \file
/// Ray casting in any kind of tree: the first hit, all hits, any hit. Sweeps of two trees, of which
/// one moves along a line: the pairs that may meet first.

#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/detail/function_ref.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace treeform {

/// The points origin + t direction for t_min <= t <= t_max. By default a ray; with a finite t_max a
/// segment, with t_min = -inf a line. The direction need not have length 1; t is in units of its
/// length. With a zero direction, the ray is a point; with t_min > t_max, it is empty.
template <std::floating_point T, std::size_t D>
struct ray {
    std::array<T, D> origin{};
    std::array<T, D> direction{};
    T t_min = 0;
    T t_max = std::numeric_limits<T>::infinity();
};

/// A primitive that a ray hits, and the value that the caller's `hit_of` returned for it.
template <class Hit>
struct ray_hit {
    std::uint32_t id;
    Hit hit;
};

namespace detail {

/// Calls `visit` as `visit_ray` does.
template <std::size_t D>
TREEFORM_API void trace(const tree<D>& tree, const ray<double, D>& ray,
                        function_ref<double(std::uint32_t)> visit);

template <tree_of_trees Trees, class Visit>
void trace(const Trees& trees, ray<double, Trees::dimensions> rest, const Visit& visit) {
    trace(trees.top(), rest, [&](std::uint32_t part) {
        trace(trees.part(part), rest, [&](std::uint32_t id) {
            if (id != no_primitive) rest.t_max = visit(id);
            return rest.t_max;
        });
        return rest.t_max;
    });
}

/// The parameter of a hit: the hit itself if it is a number, else its member t.
template <class Hit>
[[nodiscard]] constexpr double parameter_of(const Hit& hit) {
    if constexpr (std::is_arithmetic_v<Hit>)
        return static_cast<double>(hit);
    else
        return static_cast<double>(hit.t);
}

template <class HitOf>
using hit_type =
    typename std::remove_cvref_t<std::invoke_result_t<const HitOf&, std::uint32_t>>::value_type;

template <std::floating_point T, std::size_t D>
[[nodiscard]] constexpr ray<double, D> in_double(const ray<T, D>& r) {
    ray<double, D> result;
    for (std::size_t k = 0; k < D; ++k) {
        result.origin[k] = static_cast<double>(r.origin[k]);
        result.direction[k] = static_cast<double>(r.direction[k]);
    }
    result.t_min = static_cast<double>(r.t_min);
    result.t_max = static_cast<double>(r.t_max);
    return result;
}

}  // namespace detail

/// Calls `visit(id)` for every primitive whose box the ray meets; touching counts. It also visits
/// some whose boxes the ray misses by less than the rounding of the tree's float boxes. Boxes that
/// the ray enters earlier usually come earlier. `visit` returns the new t_max: boxes that the ray
/// enters later are skipped, and -inf ends the search.
///
/// No box is missed because of rounding: not for zero, tiny or huge components, not for boxes that
/// the ray only touches, not for an origin far away. The t_max that `visit` returns may be too
/// small by a relative error of 2^-40: still no box is missed.
///
/// \throws std::invalid_argument for an origin or direction that is not finite, or a NaN parameter
/// \cost   O(log N + boxes met) for most rays; serial; no allocation
/// \same   primitives whose boxes the ray meets up to t_max are always visited; which others are
///         visited may depend on the processor
/// \source the slab test of Kay and Kajiya, SIGGRAPH 1986; bounds as in Ize, Robust BVH Ray
///         Traversal, JCGT 2 (2013), derived anew for scaled frames in ray.cpp
template <any_tree Tree, std::floating_point T, class Visit>
requires std::is_invocable_r_v<double, const Visit&, std::uint32_t>
void visit_ray(const Tree& tree, const ray<T, Tree::dimensions>& ray, const Visit& visit) {
    detail::trace(tree, detail::in_double(ray), visit);
}

/// The hit with the least t; of hits with equal t, the one with the lowest id. None if there is no
/// hit.
///
/// `hit_of(id)` returns whether and where the ray hits a primitive: a `std::optional` of a number
/// t, or of a struct with a member t. A t outside [t_min, t_max], or NaN, is no hit. A hit must lie
/// in the primitive's box, and the relative error of its t must be at most 2^-40.
///
/// \throws std::invalid_argument as `visit_ray`
/// \cost   O(log N + boxes entered before the hit) for most rays
/// \same   as a loop over all primitives, for any order of the tree
template <any_tree Tree, std::floating_point T, class HitOf>
[[nodiscard]] auto first_hit(const Tree& tree, const ray<T, Tree::dimensions>& ray,
                             const HitOf& hit_of) {
    const double t_min = static_cast<double>(ray.t_min);
    double t_best = static_cast<double>(ray.t_max);
    std::optional<ray_hit<detail::hit_type<HitOf>>> best;
    visit_ray(tree, ray, [&](std::uint32_t id) {
        if (auto hit = hit_of(id)) {
            const double t = detail::parameter_of(*hit);
            if (t_min <= t && t <= t_best && (!best || t < t_best || id < best->id)) {
                t_best = t;
                best = {id, std::move(*hit)};
            }
        }
        return t_best;
    });
    return best;
}

/// All hits, ascending by t, then by id. See `first_hit` for `hit_of`.
///
/// \throws std::invalid_argument as `visit_ray`
/// \cost   O(log N + boxes met + H log H) for most rays, H hits
/// \same   as `first_hit`
template <any_tree Tree, std::floating_point T, class HitOf>
[[nodiscard]] auto all_hits(const Tree& tree, const ray<T, Tree::dimensions>& ray,
                            const HitOf& hit_of) {
    const double t_min = static_cast<double>(ray.t_min);
    const double t_max = static_cast<double>(ray.t_max);
    std::vector<ray_hit<detail::hit_type<HitOf>>> hits;
    visit_ray(tree, ray, [&](std::uint32_t id) {
        if (auto hit = hit_of(id)) {
            const double t = detail::parameter_of(*hit);
            if (t_min <= t && t <= t_max) hits.push_back({id, std::move(*hit)});
        }
        return t_max;
    });
    std::sort(hits.begin(), hits.end(), [](const auto& a, const auto& b) {
        const double of_a = detail::parameter_of(a.hit);
        const double of_b = detail::parameter_of(b.hit);
        return of_a != of_b ? of_a < of_b : a.id < b.id;
    });
    return hits;
}

/// Whether there is any hit. Stops at the first one found, so it calls `hit_of` for fewer
/// primitives than `first_hit`. Here `hit_of` may also return a bool: whether the ray hits the
/// primitive within [t_min, t_max].
///
/// \throws std::invalid_argument as `visit_ray`
/// \cost   at most that of `all_hits`
/// \same   the answer, as for `first_hit`. The primitives for which `hit_of` is called may depend
///         on the processor
template <any_tree Tree, std::floating_point T, class HitOf>
[[nodiscard]] bool any_hit(const Tree& tree, const ray<T, Tree::dimensions>& ray,
                           const HitOf& hit_of) {
    const double t_min = static_cast<double>(ray.t_min);
    const double t_max = static_cast<double>(ray.t_max);
    bool found = false;
    visit_ray(tree, ray, [&](std::uint32_t id) {
        const auto hit = hit_of(id);
        if constexpr (std::is_same_v<decltype(hit), const bool>) {
            found = hit;
        } else if (hit) {
            const double t = detail::parameter_of(*hit);
            found = t_min <= t && t <= t_max;
        }
        return found ? -std::numeric_limits<double>::infinity() : t_max;
    });
    return found;
}

namespace detail {

template <std::size_t D>
TREEFORM_API void sweep(const transformed<D>& a, const transformed<D>& b,
                        const std::array<double, D>& motion, double latest,
                        function_ref<double(std::uint32_t, std::uint32_t)> visit);

}  // namespace detail

/// Calls `visit(i, j)` for every pair of a primitive i of `a` and j of `b` whose boxes may have a
/// common point at some time t in [0, latest], when `a` is moved by t times `motion` (anything with
/// []). Pairs that may meet early usually come first. `visit` returns a new `latest`: pairs that
/// can only meet after it are skipped. A larger value than before has no effect.
///
/// Either side may be `transformed{tree, map}`. Only boxes are swept: `visit` must determine
/// whether and when two primitives meet.
///
/// \throws std::invalid_argument for a motion that is zero or not finite, or a time that is
///         negative or NaN
/// \cost   in most cases as `nearest_pair`; serial. Less for a motion along an axis, more for a
///         diagonal motion, since swept boxes are then much larger than their contents
/// \same   order and pairs, on every machine
/// \source slabs: Kay and Kajiya, Ray Tracing Complex Scenes, SIGGRAPH 1986, for the ray from 0
///         along the motion and the box of differences of two boxes
template <tree_or_transformed A, tree_or_transformed B, class Motion, class Visit>
requires std::is_invocable_r_v<double, const Visit&, std::uint32_t, std::uint32_t>
void visit_swept(const A& a, const B& b, const Motion& motion, const Visit& visit,
                 double latest = std::numeric_limits<double>::infinity()) {
    constexpr std::size_t D = A::dimensions;
    std::array<double, D> along;
    for (std::size_t k = 0; k < D; ++k) along[k] = static_cast<double>(motion[k]);
    detail::sweep<D>(a, b, along, latest, visit);
}

}  // namespace treeform
