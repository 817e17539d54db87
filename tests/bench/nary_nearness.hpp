#pragma once
/// \file
/// What the paper searches its own tree for beyond libtree/nary_search.hpp: the nearest primitive,
/// the nearest pair, and whether there is any pair, on one thread.
///
/// \source Sajovic, Knez and Korez, tf::tree, section III-D, without its bound from above by the
///         min-max distance of boxes: two boxes may lie on each other and their contents far apart

#include <libtree/paper/nary_tree.hpp>
#include <libtree/query/node_orders.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace treeform::bench {

/// Squared distance of two boxes.
template <class T, std::size_t D>
[[nodiscard]] double squared_distance(const aabb<T, D>& a, const aabb<T, D>& b) {
    double sum = 0;
    for (std::size_t k = 0; k < D; ++k) {
        const double gap = std::max({a.min[k] - b.max[k], b.min[k] - a.max[k], T{0}});
        sum += gap * gap;
    }
    return sum;
}

/// The least `distance_of(id)`, by opening nodes in the order of `Strategy` (query/node_orders.hpp)
/// and by `distance_of_box(box)`; squared distances both. Infinite for an empty tree.
template <class Strategy, class T, std::size_t D, class BoxDistance, class Distance>
[[nodiscard]] double nary_nearest(const nary_tree<T, D>& tree, const BoxDistance& distance_of_box,
                                  const Distance& distance_of) {
    struct entry {
        double lower;
        std::uint32_t node;
    };
    double best = std::numeric_limits<double>::infinity();
    if (tree.ids.empty()) return best;
    typename Strategy::template frontier<entry, 0> frontier{Strategy{}};
    entry at{0.0, 0};
    do {
        const auto& node = tree.nodes[at.node];
        if (node.axis < 0) {
            for (std::uint32_t i = 0; i < node.size; ++i)
                best = std::min(best, distance_of(tree.ids[node.offset + i]));
            continue;
        }
        frontier.open();
        for (std::uint32_t i = 0; i < node.size; ++i) {
            const double lower = distance_of_box(tree.nodes[node.offset + i].box);
            if (lower < best) frontier.push({lower, node.offset + i});
        }
        frontier.close(node.size);
    } while (frontier.pop(at, best));
    return best;
}

/// Calls `visit(c, d)` for the pairs of nodes below `x` of `a` and `y` of `b`, not both of them
/// leaves, until it returns false, as Algorithm 2 of the paper does; all c of a d in a row. Returns
/// whether it never did.
template <class T, std::size_t D, class Visit>
bool visit_below(const nary_tree<T, D>& a, const nary_tree<T, D>& b, std::uint32_t x,
                 std::uint32_t y, const Visit& visit) {
    const auto& of_x = a.nodes[x];
    const auto& of_y = b.nodes[y];
    const bool keep_x = of_x.axis < 0, keep_y = of_y.axis < 0;
    for (std::uint32_t j = 0; j < (keep_y ? 1 : of_y.size); ++j)
        for (std::uint32_t i = 0; i < (keep_x ? 1 : of_x.size); ++i)
            if (!visit(keep_x ? x : of_x.offset + i, keep_y ? y : of_y.offset + j)) return false;
    return true;
}

/// Calls `visit(i, j)` for the primitives of two leaves until it returns false; all i of a j in a
/// row.
template <class T, std::size_t D, class Visit>
bool visit_leaves(const nary_tree<T, D>& a, const nary_tree<T, D>& b, std::uint32_t x,
                  std::uint32_t y, const Visit& visit) {
    const auto& of_x = a.nodes[x];
    const auto& of_y = b.nodes[y];
    for (std::uint32_t j = 0; j < of_y.size; ++j)
        for (std::uint32_t i = 0; i < of_x.size; ++i)
            if (!visit(a.ids[of_x.offset + i], b.ids[of_y.offset + j])) return false;
    return true;
}

/// The least `distance_of(i, j)` of primitives of two trees; see `nary_nearest`. The first tree is
/// not empty, nor is the second.
template <class Strategy, class T, std::size_t D, class BoxDistance, class Distance>
[[nodiscard]] double nary_nearest_pair(const nary_tree<T, D>& a, const nary_tree<T, D>& b,
                                       const BoxDistance& distance_of_boxes,
                                       const Distance& distance_of) {
    struct entry {
        double lower;
        std::uint32_t x, y;
    };
    double best = std::numeric_limits<double>::infinity();
    typename Strategy::template frontier<entry, 0> frontier{Strategy{}};
    entry at{0.0, 0, 0};
    do {
        if (a.nodes[at.x].axis < 0 && b.nodes[at.y].axis < 0) {
            visit_leaves(a, b, at.x, at.y, [&](std::uint32_t i, std::uint32_t j) {
                best = std::min(best, distance_of(i, j));
                return best > 0.0;
            });
            if (best == 0.0) break;
            continue;
        }
        frontier.open();
        visit_below(a, b, at.x, at.y, [&](std::uint32_t x, std::uint32_t y) {
            const double lower = distance_of_boxes(a.nodes[x].box, b.nodes[y].box);
            if (lower < best) frontier.push({lower, x, y});
            return true;
        });
        frontier.close(a.config.inner_size);
    } while (frontier.pop(at, best));
    return best;
}

/// Whether `accept(i, j)` is true for primitives of leaves below `x` and `y`, in boxes for which,
/// and for all above them, `check(box_a, box_b)` is true. Depth first.
template <class T, std::size_t D, class Check, class Accept>
[[nodiscard]] bool nary_any_pair(const nary_tree<T, D>& a, const nary_tree<T, D>& b,
                                 const Check& check, const Accept& accept, std::uint32_t x = 0,
                                 std::uint32_t y = 0) {
    if (!check(a.nodes[x].box, b.nodes[y].box)) return false;
    if (a.nodes[x].axis < 0 && b.nodes[y].axis < 0)
        return !visit_leaves(a, b, x, y,
                             [&](std::uint32_t i, std::uint32_t j) { return !accept(i, j); });
    return !visit_below(a, b, x, y, [&](std::uint32_t c, std::uint32_t d) {
        return !nary_any_pair(a, b, check, accept, c, d);
    });
}

}  // namespace treeform::bench
