#pragma once
/// \file
/// A tree that is built on demand where searches visit it: for a first contact, or a few rays, in a
/// large mesh.

#include <treeform/tree/aabb.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/build_within.hpp>
#include <treeform/tree/detail/box_in_space.hpp>
#include <treeform/tree/detail/trees_side.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <numeric>
#include <ranges>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace treeform {

/// A tree over blocks of `block_size` consecutive elements of a range. A block becomes a tree when
/// a search first visits its box. Results are those of a tree over all elements.
///
/// This pays off if consecutive elements are near each other, as in most meshes, and searches visit
/// few blocks: a contact test of two meshes computes every box, but builds only some blocks. If
/// blocks turn out to be about as wide as the whole, as for elements in random order, everything is
/// built at once instead. For searches that visit most blocks, such as all pairs, or for many
/// searches, `build` is better.
///
/// A `tree_of_trees`, which the searches of search.hpp, nearness.hpp, ray.hpp, ... accept. Searches
/// may run on several threads at once: each block is built once, and threads that need it meanwhile
/// wait. Which blocks are built may depend on the threads; results do not.
template <std::size_t D>
class lazy_tree {
  public:
    static constexpr std::size_t dimensions = D;
    static constexpr std::size_t block_size = 4096;

    /// \pre    `range`, and everything that `make_aabb` refers to, outlives the tree and does not
    ///         change; `make_aabb` may be called from several threads at once
    /// \throws std::invalid_argument naming the element whose box is not finite or is empty
    /// \cost   O(N), with one call of `make_aabb` for each element, and another for elements of
    ///         blocks that are built
    /// \same   on any number of threads
    template <std::ranges::random_access_range Range, class MakeBox>
    requires box_maker<MakeBox, std::ranges::range_reference_t<const Range>> lazy_tree(
        const Range& range, const MakeBox& make_aabb)
        : size_(static_cast<std::size_t>(std::ranges::size(range))),
          split_block_([&range, make_aabb](std::size_t begin, std::size_t end) {
              std::vector<std::uint32_t> ids(end - begin);
              std::iota(ids.begin(), ids.end(), static_cast<std::uint32_t>(begin));
              tree<D> boxes = build(
                  ids, [&](std::uint32_t i) { return make_aabb(detail::element_at(range, i)); });
              for (std::size_t i = 0; i < ids.size(); ++i)
                  boxes.ids_data()[i] += static_cast<std::uint32_t>(begin);
              return boxes;
          }) {
        if (size_ > tree<D>::max_size)
            throw std::invalid_argument("treeform::lazy_tree: " + std::to_string(size_) +
                                        " elements are too many");
        const bool at_once = is_loose(range, make_aabb);
        if (at_once) per_block_ = size_;
        parts_ = std::make_unique<block[]>(chunk_count(size_, per_block_));
        if (at_once) {
            (void)part(0);  // now: searching threads must not wait for such a long build
            const box all = detail::box_of_root(parts_[0].boxes);
            top_ = detail::tree_in_order(std::span(&all, 1));
        } else {
            const std::vector<box> boxes = detail::for_boxes<box>(
                "treeform::lazy_tree", range, make_aabb,
                [](box& mine, std::size_t, const box& one) { mine.include(one); }, block_size);
            top_ = build(boxes, [](const box& one) { return one; });
        }
    }

    [[nodiscard]] std::size_t size() const { return size_; }
    /// The tree over the blocks, and the tree of a block, which is built if needed.
    [[nodiscard]] const tree<D>& top() const { return top_; }
    [[nodiscard]] const tree<D>& part(std::uint32_t number) const {
        block& one = parts_[number];
        one.split.call([&] {
            one.boxes =
                split_block_(number * per_block_, std::min(size_, (number + 1) * per_block_));
            split_->fetch_add(1, std::memory_order_relaxed);
        });
        return one.boxes;
    }

    [[nodiscard]] std::size_t block_count() const { return top_.size(); }
    /// Number of blocks that were built so far.
    [[nodiscard]] std::size_t built_block_count() const {
        return split_->load(std::memory_order_relaxed);
    }

  private:
    using box = aabb<double, D>;
    struct block {
        detail::once split;
        tree<D> boxes;
    };

    /// The sum of the extents of a box, scaled down to be finite.
    static double extent(const box& of) {
        double sum = 0.0;
        for (std::size_t k = 0; k < D; ++k) sum += 0x1p-10 * of.max[k] - 0x1p-10 * of.min[k];
        return sum;
    }

    /// Whether blocks, in a sample of up to 32, are on average at least half as wide as the whole.
    template <class Range, class MakeBox>
    [[nodiscard]] bool is_loose(const Range& range, const MakeBox& make_aabb) const {
        constexpr std::size_t samples = 32;
        const std::size_t blocks = chunk_count(size_, block_size);
        if (blocks < 2) return false;
        const std::size_t asked = std::min(blocks, samples);
        box all;
        double sum = 0.0;
        for (std::size_t i = 0; i < asked; ++i) {
            const std::size_t begin = i * blocks / asked * block_size;
            const std::size_t count = std::min(block_size, size_ - begin);
            box mine;
            for (std::size_t j = 0; j < samples; ++j)
                mine.include(detail::in_double(
                    make_aabb(detail::element_at(range, begin + j * count / samples))));
            all.include(mine);
            sum += extent(mine) / static_cast<double>(asked);
        }
        return 2.0 * sum > extent(all);
    }

    std::size_t size_;
    std::size_t per_block_ = block_size;
    std::function<tree<D>(std::size_t begin, std::size_t end)> split_block_;
    tree<D> top_;
    std::unique_ptr<block[]> parts_;
    std::unique_ptr<std::atomic<std::size_t>> split_ = std::make_unique<std::atomic<std::size_t>>();
};

template <std::ranges::random_access_range Range, class MakeBox>
lazy_tree(const Range&, const MakeBox&) -> lazy_tree<detail::box_made<Range, MakeBox>::dimensions>;

static_assert(tree_of_trees<lazy_tree<3>>);

}  // namespace treeform
