#pragma once
/// \file
/// A tree with insertions, removals and moves: a `tree_of_trees`, which the searches of search.hpp,
/// nearness.hpp, ray.hpp, ... accept.

#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <ranges>
#include <span>
#include <vector>

namespace treeform {

template <std::size_t D>
class dynamic_tree;

namespace detail {

/// The cost of all updates of a `dynamic_tree`: its bound is documented, and tested.
struct update_counts {
    std::uint64_t built = 0;     ///< primitives in builds of trees, counted for each build
    std::uint64_t refitted = 0;  ///< boxes updated in place
    std::uint64_t vacated = 0;   ///< primitives taken out of a tree: removed, or moved elsewhere

    template <std::size_t D>
    [[nodiscard]] static const update_counts& of(const dynamic_tree<D>& tree) {
        return tree.counts_;
    }
    friend bool operator==(const update_counts&, const update_counts&) = default;
};

}  // namespace detail

/// A tree over a changing set of primitives: batches are inserted, removed and moved. Searches give
/// the same results as on a new tree of the present primitives. No search may run during an update.
///
/// A primitive keeps its id until it is removed. Ids of removed primitives are reused, the last
/// removed first. The tree keeps a copy of the boxes.
///
/// It consists of a few packed trees, each at least four times as large as the next smaller one.
/// - A primitive that moves a little is updated in its slot. "A little" means within the box of its
///   neighborhood (up to 64 primitives around it in leaf order) at the time when their tree was
///   built, widened by a quarter. So no box above the leaf blocks grows by more than that.
/// - A primitive that moves further, or is removed, leaves an empty slot, which does not slow down
///   searches. A tree with more empty slots than full ones is dissolved.
/// - New primitives, those that moved further, and those of dissolved trees form a new tree,
///   together with the trees that are less than four times as large.
///
/// So there are always at most 2 + log4(N / 32) trees, each at least half full. Searches usually
/// visit up to 3 times as many nodes as in a new tree.
///
/// \cost   About 90 bytes a primitive with D = 3. An update of K primitives costs O(K log N), plus
///         a pass over N / 8 bytes if K is above N / 128, plus builds. Amortized over all updates,
///         builds process at most 64 + 3.2 log2 N primitives for each one that is inserted or moves
///         beyond its neighborhood, and 5 for each one that is removed; far fewer in batches. A
///         batch of N / 10 such moves builds a tree of N / 10 primitives; every third batch
///         rebuilds all
/// \same   on any number of threads
/// \source the logarithmic method of Bentley and Saxe, Decomposable Searching Problems I, J.
///         Algorithms 1 (1980); refits after van den Bergen, JGT 2 (1997)
template <std::size_t D>
class TREEFORM_API dynamic_tree {
  public:
    static constexpr std::size_t dimensions = D;
    using box_type = aabb<double, D>;

    dynamic_tree() = default;
    /// Over the elements of `range`, with the ids 0 ... N-1. See `insert`.
    template <std::ranges::random_access_range Range, class MakeBox>
    dynamic_tree(const Range& range, const MakeBox& make_aabb) {
        (void)insert(range, make_aabb);
    }

    /// Adds the elements of `range`, and returns their ids [K]. `make_aabb` as for `build`; without
    /// one, the elements are boxes.
    ///
    /// \throws std::invalid_argument naming the element whose box is not finite or is empty; for
    ///         too many elements; the tree is then unchanged
    std::vector<std::uint32_t> insert(std::span<const box_type> boxes);
    template <std::ranges::random_access_range Range, class MakeBox = std::identity>
    std::vector<std::uint32_t> insert(const Range& range, const MakeBox& make_aabb = {}) {
        return insert(std::span<const box_type>(boxes_of(range, make_aabb)));
    }

    /// Removes the primitives `ids`.
    ///
    /// \throws std::invalid_argument naming an id that does not exist or is repeated; the tree is
    ///         then unchanged
    void remove(std::span<const std::uint32_t> ids);

    /// Gives primitive `ids[i]` the box of element i of `range`, or `boxes[i]`.
    ///
    /// \throws std::invalid_argument as `remove`; naming the id whose new box is not finite or is
    ///         empty; if there are not as many boxes as ids; the tree is then unchanged
    void move(std::span<const std::uint32_t> ids, std::span<const box_type> boxes);
    template <std::ranges::random_access_range Range, class MakeBox = std::identity>
    void move(std::span<const std::uint32_t> ids, const Range& range,
              const MakeBox& make_aabb = {}) {
        move(ids, std::span<const box_type>(boxes_of(range, make_aabb)));
    }

    /// Number of present primitives.
    [[nodiscard]] std::size_t size() const { return id_end_ - free_.size(); }
    [[nodiscard]] bool empty() const { return size() == 0; }
    /// Upper bound of ids, exclusive: the size for arrays indexed by id.
    [[nodiscard]] std::size_t id_end() const { return id_end_; }
    [[nodiscard]] bool contains(std::uint32_t id) const {
        return id < id_end_ && where_[id].place != detail::no_primitive;
    }
    /// \pre contains(id)
    [[nodiscard]] const box_type& box(std::uint32_t id) const { return boxes_[id]; }

    /// The interface of `tree_of_trees`. An update invalidates references to these trees.
    [[nodiscard]] const tree<D>& top() const { return top_; }
    [[nodiscard]] const tree<D>& part(std::uint32_t number) const { return parts_[number].boxes; }

  private:
    friend struct detail::update_counts;

    struct location {
        std::uint32_t part;
        std::uint32_t place;
    };
    struct packed {
        tree<D> boxes;
        std::size_t live = 0;          ///< slots that are not empty
        std::vector<box_type> limits;  ///< of the neighborhoods: where their primitives may move
        bool changed = true;           ///< since `top_` was last updated

        [[nodiscard]] unsigned neighborhood_level() const;
        void set_limits();
        [[nodiscard]] bool may_hold(std::uint32_t place, const box_type& box) const;
    };

    template <class Range, class MakeBox>
    static std::vector<box_type> boxes_of(const Range& range, const MakeBox& make_aabb);

    void make_room(std::size_t ids);
    void check_ids(const char* function, std::span<const std::uint32_t> ids) const;
    void vacate(std::uint32_t id);
    void settle(std::vector<std::uint32_t> pending,
                const std::vector<std::vector<std::uint32_t>>& touched);
    void dissolve(packed& from, std::vector<std::uint32_t>& to);
    void build_part(const std::vector<std::uint32_t>& ids);
    void cover_parts();

    std::size_t id_end_ = 0;
    detail::buffer<box_type> boxes_;   ///< by id, with room for more
    detail::buffer<location> where_;   ///< by id, with room for more
    std::vector<std::uint32_t> free_;  ///< ids that are not in use
    std::vector<packed> parts_;        ///< unused ones have no slots
    std::vector<box_type> roots_;      ///< box of each part; empty if the part is unused
    tree<D> top_;                      ///< over `roots_`
    detail::update_counts counts_;
};

template <std::size_t D>
template <class Range, class MakeBox>
auto dynamic_tree<D>::boxes_of(const Range& range, const MakeBox& make_aabb)
    -> std::vector<box_type> {
    std::vector<box_type> boxes(static_cast<std::size_t>(std::ranges::size(range)));
    for_chunks(boxes.size(), std::size_t{1} << 13,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t i = begin; i < end; ++i) {
                       const auto box = make_aabb(std::ranges::begin(
                           range)[static_cast<std::ranges::range_difference_t<const Range>>(i)]);
                       for (std::size_t k = 0; k < D; ++k) {
                           boxes[i].min[k] = static_cast<double>(box.min[k]);
                           boxes[i].max[k] = static_cast<double>(box.max[k]);
                       }
                   }
               });
    return boxes;
}

extern template class TREEFORM_API dynamic_tree<2>;
extern template class TREEFORM_API dynamic_tree<3>;
static_assert(tree_of_trees<dynamic_tree<3>>);

}  // namespace treeform
