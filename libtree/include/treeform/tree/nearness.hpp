#pragma once
/// \file
/// Nearness searches in any kind of tree: the primitive nearest to a point or a box, the k nearest,
/// all within a radius.

#include <treeform/tree/aabb.hpp>
#include <treeform/tree/answers.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/detail/function_ref.hpp>
#include <treeform/tree/detail/nearest_k.hpp>
#include <treeform/tree/detail/squared_radius.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace treeform {

/// The order in which nodes are opened. It affects the time, not the results.
enum class node_order : std::uint8_t {
    depth_first,   ///< the children of a node before its siblings, the nearest first
    top_k_sorted,  ///< a stack whose top is sorted after each node, as in the paper
    best_first     ///< the nearest of all unopened nodes first: opens the fewest nodes
};

/// An infinite radius, which excludes nothing. Radii are not squared, and inclusive: the root of an
/// answer's squared distance is at most the radius.
inline constexpr double unlimited_radius = std::numeric_limits<double>::infinity();

/// The box or point from which distances are measured: `treeform::aabb<T, D>`, or anything with [].
template <class Q, std::size_t D>
concept nearness_query = requires(const Q& q) {
    { q.min[D - 1] } -> std::convertible_to<double>;
    { q.max[D - 1] } -> std::convertible_to<double>;
}
|| requires(const Q& q) {
    { q[D - 1] } -> std::convertible_to<double>;
};

namespace detail {

/// Calls `visit` as `visit_near` does, starting with the bound `squared`.
template <std::size_t D>
TREEFORM_API void walk_near(const tree<D>& tree, const aabb<double, D>& query, double squared,
                            node_order order, function_ref<double(std::uint32_t)> visit);

template <tree_of_trees Trees, class Visit>
void walk_near(const Trees& trees, const aabb<double, Trees::dimensions>& query, double squared,
               node_order order, const Visit& visit) {
    walk_near(trees.top(), query, squared, order, [&](std::uint32_t part) {
        walk_near(trees.part(part), query, squared, order, [&](std::uint32_t id) {
            if (id != no_primitive) squared = visit(id);
            return squared;
        });
        return squared;
    });
}

template <std::size_t D, nearness_query<D> Query>
[[nodiscard]] aabb<double, D> box_of_query(const Query& query) {
    aabb<double, D> box;
    for (std::size_t k = 0; k < D; ++k) {
        if constexpr (requires { query.min[k]; }) {
            box.min[k] = static_cast<double>(query.min[k]);
            box.max[k] = static_cast<double>(query.max[k]);
        } else {
            box.min[k] = box.max[k] = static_cast<double>(query[k]);
        }
    }
    return box;
}

/// Keeps the best of the answers offered: the nearest; of equally near ones, the one with the
/// lowest id.
template <class Answer>
class nearest_one {
  public:
    explicit nearest_one(double squared_radius) : bound_(squared_radius) {}

    template <class DistanceOf>
    void offer(std::uint32_t id, const DistanceOf& distance_of) {
        auto answer = distance_of(id);
        const double squared = detail::squared_distance_of(answer);
        if (!(squared < bound_ || (squared == bound_ && (!best || id < best->id)))) return;
        bound_ = squared;
        best = {id, std::move(answer)};
    }
    [[nodiscard]] double bound() const { return bound_; }

    std::optional<neighbor<Answer>> best;

  private:
    double bound_;
};

}  // namespace detail

/// Calls `visit(id)` for every primitive near `query`, usually the nearest boxes first. `visit`
/// returns the new bound, a squared distance; the first bound is `radius` squared. Primitives are
/// skipped if their boxes are further away than the bound; primitives at the bound are visited, and
/// some beyond it may be.
///
/// \throws std::invalid_argument for a query that is not finite or an empty box, or a radius that
///         is negative or NaN
/// \cost   O(log N + nodes within the final bound) for most queries; serial; no allocation with the
///         default order. Boxes are compared as floats: from a query further away than about 1e5
///         times the extent of the tree they look equally near, and many are visited
/// \same   primitives within the final bound are always visited; which others are visited depends
///         on the order and the processor
/// \source Sajovic, Knez and Korez, tf::tree, section III-D; eight boxes at a time
template <any_tree Tree, nearness_query<Tree::dimensions> Query, class Visit>
requires std::is_invocable_r_v<double, const Visit&, std::uint32_t>
void visit_near(const Tree& tree, const Query& query, const Visit& visit,
                double radius = unlimited_radius, node_order order = node_order::depth_first) {
    detail::walk_near(tree, detail::box_of_query<Tree::dimensions>(query),
                      detail::squared_radius("treeform::visit_near", radius), order, visit);
}

/// The nearest primitive; of equally near ones, the one with the lowest id. None if the tree is
/// empty or all primitives are beyond the radius.
///
/// `distance_of(id)` returns the squared distance from the query to a primitive: a number, or a
/// struct with a member `squared_distance`, which becomes `neighbor::answer`. Its relative error
/// may be up to 2^-22; the result is the least value returned. NaN counts as beyond any radius. It
/// is called in no particular order, at most once for each primitive.
///
/// \throws std::invalid_argument as `visit_near`
/// \cost   as `visit_near`
/// \same   as a loop over all primitives, for any `order`
template <any_tree Tree, nearness_query<Tree::dimensions> Query, class DistanceOf>
[[nodiscard]] auto nearest(const Tree& tree, const Query& query, const DistanceOf& distance_of,
                           double radius = unlimited_radius,
                           node_order order = node_order::depth_first) {
    using answer = std::remove_cvref_t<std::invoke_result_t<const DistanceOf&, std::uint32_t>>;
    detail::nearest_one<answer> one(detail::squared_radius("treeform::nearest", radius));
    detail::walk_near(tree, detail::box_of_query<Tree::dimensions>(query), one.bound(), order,
                      [&](std::uint32_t id) {
                          one.offer(id, distance_of);
                          return one.bound();
                      });
    return one.best;
}

/// The k nearest primitives, ascending by distance, then by id; fewer if fewer are within the
/// radius. See `nearest` for `distance_of`.
///
/// \throws std::invalid_argument as `visit_near`
/// \cost   as `visit_near`, plus O(log k) for each primitive that is among the k nearest so far
/// \same   as sorting all primitives, for any `order`
template <any_tree Tree, nearness_query<Tree::dimensions> Query, class DistanceOf>
[[nodiscard]] auto k_nearest(const Tree& tree, const Query& query, std::size_t k,
                             const DistanceOf& distance_of, double radius = unlimited_radius,
                             node_order order = node_order::depth_first) {
    using answer = std::remove_cvref_t<std::invoke_result_t<const DistanceOf&, std::uint32_t>>;
    detail::nearest_k<neighbor<answer>> found(
        std::min(k, tree.size()), detail::squared_radius("treeform::k_nearest", radius));
    detail::walk_near(tree, detail::box_of_query<Tree::dimensions>(query), found.bound(), order,
                      [&](std::uint32_t id) {
                          found.offer({id, distance_of(id)});
                          return found.bound();
                      });
    return std::move(found.sorted());
}

/// All primitives within `radius` (inclusive), ascending by distance, then by id. See `nearest`
/// for `distance_of`.
///
/// \throws std::invalid_argument as `visit_near`
/// \cost   as `visit_near`, and O(A log A) for A answers
/// \same   as a loop over all primitives, for any `order`
template <any_tree Tree, nearness_query<Tree::dimensions> Query, class DistanceOf>
[[nodiscard]] auto all_within(const Tree& tree, const Query& query, double radius,
                              const DistanceOf& distance_of,
                              node_order order = node_order::depth_first) {
    using answer = std::remove_cvref_t<std::invoke_result_t<const DistanceOf&, std::uint32_t>>;
    const double bound = detail::squared_radius("treeform::all_within", radius);
    std::vector<neighbor<answer>> found;
    detail::walk_near(tree, detail::box_of_query<Tree::dimensions>(query), bound, order,
                      [&](std::uint32_t id) {
                          neighbor<answer> one{id, distance_of(id)};
                          if (one.squared_distance() <= bound) found.push_back(std::move(one));
                          return bound;
                      });
    std::sort(found.begin(), found.end(),
              [](const auto& a, const auto& b) { return nearer(a, b); });
    return found;
}

}  // namespace treeform
