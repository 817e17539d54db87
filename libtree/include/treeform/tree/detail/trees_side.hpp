#pragma once
/// \file
/// One side of a search for pairs, for any kind of tree: its parts, and a tree over them.

#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/box_in_space.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace treeform::detail {

/// A tree over finite boxes, with leaves in the order of `boxes`. `ids()` are the positions of the
/// boxes that are not empty. For few boxes: the top of a tree of trees.
template <std::size_t D>
[[nodiscard]] TREEFORM_API tree<D> tree_in_order(std::span<const aabb<double, D>> boxes);

/// A tree of trees, transformed or not.
template <std::size_t D, class Trees>
class trees_side {
  public:
    explicit trees_side(const transformed<D, Trees>& at) : at_(at) {}

    [[nodiscard]] transformed<D> top() const { return {at_.original().top(), at_.map()}; }
    [[nodiscard]] transformed<D> part(std::uint32_t number) const {
        return {at_.original().part(number), at_.map()};
    }

  private:
    transformed<D, Trees> at_;
};

/// A tree as a tree of trees: its only part is number 0.
template <std::size_t D>
class trees_side<D, tree<D>> {
  public:
    explicit trees_side(const transformed<D>& at) : at_(at) {
        const aabb<double, D> box = box_of_root(at.original());
        top_ = tree_in_order(std::span(&box, 1));
    }

    [[nodiscard]] transformed<D> top() const { return {top_, at_.map()}; }
    [[nodiscard]] transformed<D> part(std::uint32_t) const { return at_; }

  private:
    transformed<D> at_;
    tree<D> top_;
};

}  // namespace treeform::detail
