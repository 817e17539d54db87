#pragma once
/// \file
/// A tree that is built where searches come by: for a first contact, or some rays, of a large mesh
/// of which most is never looked at.

#include <treeform/tree/aabb.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/build_within.hpp>
#include <treeform/tree/nearness.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/ray.hpp>
#include <treeform/tree/search.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <ranges>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace treeform {

namespace detail {

/// A box of space around the boxes of a tree, which is not empty.
template <std::size_t D>
[[nodiscard]] aabb<double, D> box_of_root(const tree<D>& tree) {
    aabb<double, D> box;
    for (std::size_t slot = 0; slot < tree.children(0, 0); ++slot)
        box.include(box_in_space(tree.frame(), tree.level(0)[0], slot));
    return box;
}

}  // namespace detail

/// A tree over blocks of `block_size` elements that follow each other in a range, each of which
/// becomes a tree of its own when a search first comes into its box. Answers are those of a tree
/// over all.
///
/// That is worth it when elements that follow each other lie near each other, as in nearly every
/// mesh that a program has made, and a search sees little of it: whether two meshes have any
/// contact is known after a look at every box and the builds of some blocks. Where the blocks turn
/// out to be as wide as the whole, as of elements in random order, all is built at once instead.
/// For searches that see most of it, as all pairs, and for many of them, `build` is better.
///
/// Searches are const and may run on any threads at once: a block is split once, those who want it
/// meanwhile wait.
template <std::size_t D>
class lazy_tree {
  public:
    static constexpr std::size_t dimensions = D;
    static constexpr std::size_t block_size = 4096;

    /// \pre    `range` and what `make_aabb` refers to outlive the tree and do not change; calls of
    ///         `make_aabb` come from several threads
    /// \throws std::invalid_argument naming the element whose box is not finite or is empty
    /// \cost   O(N), one call of `make_aabb` an element; another for those in blocks that are split
    /// \same   on any number of threads
    template <std::ranges::random_access_range Range, class MakeBox>
    requires box_maker<MakeBox, std::ranges::range_reference_t<const Range>> lazy_tree(
        const Range& range, const MakeBox& make_aabb)
        : size_(static_cast<std::size_t>(std::ranges::size(range))),
          split_block_([&range, make_aabb](std::size_t begin, std::size_t end) {
              std::vector<std::uint32_t> ids(end - begin);
              std::iota(ids.begin(), ids.end(), static_cast<std::uint32_t>(begin));
              tree<D> boxes = build(
                  ids, [&](std::uint32_t i) { return make_aabb(detail::at_place(range, i)); });
              for (std::size_t i = 0; i < ids.size(); ++i)
                  boxes.ids_data()[i] += static_cast<std::uint32_t>(begin);
              return boxes;
          }) {
        if (size_ > tree<D>::max_size)
            throw std::invalid_argument("treeform::lazy_tree: " + std::to_string(size_) +
                                        " elements are too many");
        const bool at_once = is_loose(range, make_aabb);
        if (at_once) per_block_ = size_;
        parts_ = std::make_unique<part[]>(chunk_count(size_, per_block_));
        if (at_once) {
            (void)block(0);  // not in a search: no thread may wait for a build on all of them
            top_ = over({detail::box_of_root(parts_[0].boxes)});
        } else {
            top_ = over(detail::for_boxes<box>(
                "treeform::lazy_tree", range, make_aabb,
                [](box& mine, std::size_t, const box& one) { mine.include(one); }, block_size));
        }
    }

    [[nodiscard]] std::size_t size() const { return size_; }
    /// Over the blocks: `top().ids()` are numbers of blocks.
    [[nodiscard]] const tree<D>& top() const { return top_; }
    /// The tree of a block, which is split if it was not: its `ids()` are places in the range.
    [[nodiscard]] const tree<D>& block(std::uint32_t number) const {
        part& one = parts_[number];
        one.split.call([&] {
            one.boxes =
                split_block_(number * per_block_, std::min(size_, (number + 1) * per_block_));
            split_->fetch_add(1, std::memory_order_relaxed);
        });
        return one.boxes;
    }

    [[nodiscard]] std::size_t blocks() const { return top_.size(); }
    /// Blocks that searches have made trees of so far; the others were skipped.
    [[nodiscard]] std::size_t split() const { return split_->load(std::memory_order_relaxed); }

  private:
    using box = aabb<double, D>;
    struct part {
        once split;
        tree<D> boxes;
    };

    /// The sum of the extents of a box, scaled down: finite.
    static double extent(const box& of) {
        double sum = 0.0;
        for (std::size_t k = 0; k < D; ++k) sum += 0x1p-10 * of.max[k] - 0x1p-10 * of.min[k];
        return sum;
    }

    /// Whether blocks, by samples of up to 32 of them, reach half as far as the whole on average.
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
                    make_aabb(detail::at_place(range, begin + j * count / samples))));
            all.include(mine);
            sum += extent(mine) / static_cast<double>(asked);
        }
        return 2.0 * sum > extent(all);
    }

    static tree<D> over(const std::vector<box>& boxes) {
        return build(boxes, [](const box& one) { return one; });
    }

    std::size_t size_;
    std::size_t per_block_ = block_size;
    std::function<tree<D>(std::size_t begin, std::size_t end)> split_block_;
    tree<D> top_;
    std::unique_ptr<part[]> parts_;
    std::unique_ptr<std::atomic<std::size_t>> split_ = std::make_unique<std::atomic<std::size_t>>();
};

template <std::ranges::random_access_range Range, class MakeBox>
lazy_tree(const Range&, const MakeBox&) -> lazy_tree<detail::box_made<Range, MakeBox>::dimensions>;

/// As the searches of a `tree` of the same name, block by block; with this one come `search_any`
/// and `search_all`.
template <std::size_t D, tree_query<D> Query, class Apply>
search_statistics search(const lazy_tree<D>& tree, const Query& query, const Apply& apply) {
    search_statistics below;
    bool stopped = false;
    search_statistics seen = search(tree.top(), query, [&](std::uint32_t block) {
        below += search(tree.block(block), query, [&](std::uint32_t id) {
            return stopped = detail::asks_to_stop(apply, id);
        });
        return stopped;
    });
    seen.candidates = 0;  // blocks
    return seen += below;
}

/// Whether `accept(a, b)` is true for some pair of elements whose boxes overlap; it is called from
/// several threads, and no more once one is known. Which blocks are split depends on the threads,
/// the answer does not.
template <std::size_t D, class Accept>
[[nodiscard]] bool search_any(const lazy_tree<D>& a, const lazy_tree<D>& b, const Accept& accept) {
    const std::vector<id_pair> blocks = search_all(a.top(), b.top());
    if (blocks.size() == 1)
        return search_any(a.block(blocks[0].first), b.block(blocks[0].second), accept);
    std::atomic<bool> found{false};
    for_chunks(blocks.size(), 1, [&](std::size_t i, std::size_t, std::size_t) {
        if (found.load(std::memory_order_relaxed)) return;
        const tree<D>& in_a = a.block(blocks[i].first);
        const tree<D>& in_b = b.block(blocks[i].second);
        pair_search<D>::visit_all(in_a, in_b, [&](const candidate_block& block) {
            for (std::size_t j = 0; j < block.first.size(); ++j)
                if (accept(in_a.ids()[block.first[j]], in_b.ids()[block.second[j]]))
                    found.store(true, std::memory_order_relaxed);
            return !found.load(std::memory_order_relaxed);
        });
    });
    return found.load();
}

template <std::floating_point T, std::size_t D, class HitOf>
[[nodiscard]] auto first_hit(const lazy_tree<D>& tree, const ray<T, D>& ray, const HitOf& hit_of) {
    std::optional<ray_hit<detail::hit_type<HitOf>>> best;
    auto rest = detail::in_double(ray);
    visit_along(tree.top(), rest, [&](std::uint32_t block) {
        auto hit = first_hit(tree.block(block), rest, hit_of);
        if (hit) {
            const double t = detail::parameter_of(hit->hit);
            if (!best || t < rest.t_max || hit->id < best->id) best = std::move(hit);
            rest.t_max = t;
        }
        return rest.t_max;
    });
    return best;
}

template <std::floating_point T, std::size_t D, class HitOf>
[[nodiscard]] bool any_hit(const lazy_tree<D>& tree, const ray<T, D>& ray, const HitOf& hit_of) {
    bool found = false;
    visit_along(tree.top(), ray, [&](std::uint32_t block) {
        found = any_hit(tree.block(block), ray, hit_of);
        return found ? -std::numeric_limits<double>::infinity() : static_cast<double>(ray.t_max);
    });
    return found;
}

template <std::size_t D, nearness_query<D> Query, class DistanceOf>
[[nodiscard]] auto nearest(const lazy_tree<D>& tree, const Query& query,
                           const DistanceOf& distance_of, const nearness_options& options = {}) {
    using answer = std::remove_cvref_t<std::invoke_result_t<const DistanceOf&, std::uint32_t>>;
    detail::nearest_one<answer> one(detail::squared_radius("treeform::nearest", options.radius));
    const aabb<double, D> box = detail::box_of_query<D>(query);
    const auto visit = [&](std::uint32_t id) {
        one.offer(id, distance_of);
        return one.bound();
    };
    detail::approach<D>(tree.top(), box, one.bound(), options.strategy, [&](std::uint32_t block) {
        detail::approach<D>(tree.block(block), box, one.bound(), options.strategy, visit);
        return one.bound();
    });
    return one.best;
}

}  // namespace treeform
