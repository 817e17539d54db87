#pragma once
/// \file
/// The paper's own tree, box by box: the pair <ids, nodes> with explicit ranges and any arity.
///
/// For arities and leaf sizes other than those of `tree`, and to reproduce and compare the paper's
/// figures.

#include <libtree/paper/selections.hpp>
#include <libtree/paper/tree_config.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <ranges>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace treeform {

/// \source Sajovic, Knez and Korez, tf::tree, Definition 2
template <std::floating_point T, std::size_t D>
struct nary_node {
    aabb<T, D> box;
    std::uint32_t offset = 0;  ///< first child: a node, or for a leaf a place in `ids`
    std::uint32_t size = 0;    ///< number of children; 0 for a node that is not part of the tree
    std::int32_t axis = -1;    ///< axis along which an inner node was cut; -1 for a leaf
};

/// \source Sajovic, Knez and Korez, tf::tree, Definition 3
template <std::floating_point T, std::size_t D>
struct nary_tree {
    std::vector<std::uint32_t> ids;
    std::vector<nary_node<T, D>> nodes;  ///< the children of node n start at inner_size * n + 1
    tree_config config;
};

namespace detail {

/// Algorithm 1 of the paper on the boxes of all primitives.
template <partition_strategy Strategy, class T, std::size_t D>
class nary_builder {
  public:
    nary_builder(std::span<const aabb<T, D>> boxes, nary_tree<T, D>& tree)
        : boxes_(boxes), tree_(tree) {}

    void run() {
        const std::size_t count = boxes_.size();
        tree_.ids.resize(count);
        std::iota(tree_.ids.begin(), tree_.ids.end(), std::uint32_t{0});
        tree_.nodes.assign(nodes_for(count), {});
        if (count == 0) return;
        // Level by level while nodes are large, then one task for each subtree; in the paper's
        // recursion, the first cuts would be serial.
        std::vector<work> level{{0, 0, count}};
        while (!level.empty() && level.size() < 256) {
            std::vector<std::vector<work>> children(level.size());
            for_chunks(level.size(), 1, [&](std::size_t i, std::size_t, std::size_t) {
                children[i] = visit(level[i]);
            });
            level.clear();
            for (const auto& of_one : children)
                level.insert(level.end(), of_one.begin(), of_one.end());
        }
        for_chunks(level.size(), 1,
                   [&](std::size_t i, std::size_t, std::size_t) { descend(level[i]); });
    }

  private:
    struct work {
        std::size_t node, begin, end;
    };

    /// Number of nodes of the shallowest perfect tree in which no leaf is too large.
    [[nodiscard]] std::size_t nodes_for(std::size_t count) const {
        std::size_t total = 1, level = 1;
        while (count > level * tree_.config.leaf_size) {
            level *= tree_.config.inner_size;
            total += level;
        }
        return total;
    }

    std::vector<work> visit(const work& w) {
        nary_node<T, D>& node = tree_.nodes[w.node];
        for (std::size_t i = w.begin; i < w.end; ++i) node.box.include(boxes_[tree_.ids[i]]);
        if (w.end - w.begin <= tree_.config.leaf_size) {
            node.offset = static_cast<std::uint32_t>(w.begin);
            node.size = static_cast<std::uint32_t>(w.end - w.begin);
            return {};
        }
        node.axis = 0;
        for (std::size_t k = 1; k < D; ++k)
            if (extent(node.box, k) > extent(node.box, static_cast<std::size_t>(node.axis)))
                node.axis = static_cast<std::int32_t>(k);
        const std::size_t arity = tree_.config.inner_size;
        const std::size_t first_child = arity * w.node + 1;
        node.offset = static_cast<std::uint32_t>(first_child);
        node.size = static_cast<std::uint32_t>(arity);
        std::vector<std::size_t> cuts(arity + 1);
        for (std::size_t c = 0; c <= arity; ++c) cuts[c] = w.begin + (w.end - w.begin) * c / arity;
        partition(cuts, 0, arity, static_cast<std::size_t>(node.axis));
        std::vector<work> children(arity);
        for (std::size_t c = 0; c < arity; ++c)
            children[c] = {first_child + c, cuts[c], cuts[c + 1]};
        return children;
    }

    /// Separates the parts [first, last) by cutting in the middle, then cutting each half.
    void partition(const std::vector<std::size_t>& cuts, std::size_t first, std::size_t last,
                   std::size_t axis) {
        if (last - first < 2) return;
        const std::size_t middle = (first + last) / 2;
        const auto at = [&](std::size_t cut) {
            return tree_.ids.begin() + static_cast<std::ptrdiff_t>(cuts[cut]);
        };
        Strategy::partition(at(first), at(middle), at(last), [&](std::uint32_t a, std::uint32_t b) {
            return center(boxes_[a], axis) < center(boxes_[b], axis);
        });
        partition(cuts, first, middle, axis);
        partition(cuts, middle, last, axis);
    }

    void descend(const work& w) {
        for (const work& child : visit(w)) descend(child);
    }

    // Halved first, so that extreme coordinates stay finite.
    static T extent(const aabb<T, D>& box, std::size_t k) {
        return T{0.5} * box.max[k] - T{0.5} * box.min[k];
    }
    static T center(const aabb<T, D>& box, std::size_t k) {
        return T{0.5} * box.max[k] + T{0.5} * box.min[k];
    }

    std::span<const aabb<T, D>> boxes_;
    nary_tree<T, D>& tree_;
};

}  // namespace detail

/// The paper's tree over the boxes that `make_aabb` returns for the elements of `range`.
///
/// \throws std::invalid_argument for an inner size outside 2 ... 16 or a leaf size of 0, or naming
///         the element whose box is empty or not finite
/// \cost   O(N log N) expected time with a selection in linear time
/// \same   on any number of threads; `make_aabb` is called once for each element, in order
/// \source Sajovic, Knez and Korez, tf::tree, Algorithm 1
template <partition_strategy Strategy = strategy::nth_element, std::ranges::input_range Range,
          class MakeBox>
requires box_maker<MakeBox, std::ranges::range_reference_t<Range>>
[[nodiscard]] auto build(Range&& range, const MakeBox& make_aabb, const tree_config& config) {
    using box = std::remove_cvref_t<decltype(make_aabb(*std::ranges::begin(range)))>;
    if (config.inner_size < 2 || config.inner_size > 16)
        throw std::invalid_argument("treeform::build: inner_size " +
                                    std::to_string(config.inner_size) + " is not in 2 ... 16");
    if (config.leaf_size == 0) throw std::invalid_argument("treeform::build: leaf_size 0");
    std::vector<box> boxes;
    if constexpr (std::ranges::sized_range<Range>) boxes.reserve(std::ranges::size(range));
    for (auto&& element : range) {
        boxes.push_back(make_aabb(element));
        if (!detail::is_finite(boxes.back()))
            throw std::invalid_argument("treeform::build: the box of element " +
                                        std::to_string(boxes.size() - 1) +
                                        " is empty or not finite");
    }
    nary_tree<typename box::scalar, box::dimensions> result;
    result.config = config;
    detail::nary_builder<Strategy, typename box::scalar, box::dimensions>(boxes, result).run();
    return result;
}

}  // namespace treeform
