#include <libtree/query/candidate_sink.hpp>
#include <libtree/query/map_back.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search_pair.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <limits>
#include <span>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libtree/query/search_pair.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Behind the two, as they are compiled for each target.
#include <libtree/query/map_node-inl.hpp>
#include <libtree/query/overlap_mask-inl.hpp>

#ifndef TREEFORM_SEARCH_PAIR_ONCE
#define TREEFORM_SEARCH_PAIR_ONCE
namespace treeform::detail {
namespace {

/// Pairs of nodes of one height in each tree; leaf blocks have height 0.
struct frontier {
    unsigned height_a, height_b;
    std::vector<node_pair> items;
};

}  // namespace
}  // namespace treeform::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::HWY_NAMESPACE {
namespace {

/// A node of a tree in the common frame and, where boxes are compared twice, in the other one.
template <std::size_t D>
struct framed_node {
    const wide_node<D>* common;
    const wide_node<D>* own;
};

/// A node, and where its box is.
template <std::size_t D>
struct node_location {
    unsigned height;
    std::size_t node;
    framed_node<D> parent;
    std::size_t slot;
};

/// The nodes of a tree in a frame. Those moved last are kept, of each height one for each slot of a
/// parent: a search goes down to the children of one node in a row.
template <std::size_t D>
class framed_nodes {
  public:
    framed_nodes(const tree<D>& t, const frame_map<D>& map) : map_(map) {
        for (unsigned level = 0; level < t.levels(); ++level)
            nodes_[t.levels() - 1 - level] = t.level(level).data();
        top_ = t.levels() - 1;
        if (!map_.identity)
            for (unsigned height = 0; height <= top_; ++height) moved_at_[height].fill(none);
    }
    framed_nodes(const framed_nodes&) = delete;
    framed_nodes& operator=(const framed_nodes&) = delete;

    [[nodiscard]] unsigned top() const { return top_; }

    const wide_node<D>& node(unsigned height, std::size_t i) {
        const wide_node<D>& original = nodes_[height][i];
        if (map_.identity) return original;
        std::size_t& at = moved_at_[height][i % 8];
        wide_node<D>& moved = moved_[height][i % 8];
        if (at != i) {
            map_node(map_, original, moved);
            at = i;
        }
        return moved;
    }

    /// Asks memory for what `node` reads.
    void prefetch(unsigned height, std::size_t i) const {
        const auto* at = reinterpret_cast<const char*>(nodes_[height] + i);
        for (std::size_t byte = 0; byte < sizeof(wide_node<D>); byte += 64)
            __builtin_prefetch(at + byte);
    }

    /// The node above; for the root one whose first child it is.
    [[nodiscard]] const wide_node<D>* above(unsigned height, std::size_t i) {
        if (height != top_) return &node(height + 1, i / 8);
        const wide_node<D>& root = node(top_, 0);
        for (std::size_t k = 0; k < D; ++k) {
            above_root_.min[k][0] = *std::min_element(root.min[k], root.min[k] + 8);
            above_root_.max[k][0] = *std::max_element(root.max[k], root.max[k] + 8);
        }
        return &above_root_;
    }

  private:
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    static constexpr std::size_t max_levels = 11;  // 8^11 > 2^32

    const frame_map<D>& map_;
    unsigned top_ = 0;
    std::array<const wide_node<D>*, max_levels> nodes_{};
    std::array<std::array<std::size_t, 8>, max_levels> moved_at_;
    std::array<std::array<wide_node<D>, 8>, max_levels> moved_;
    wide_node<D> above_root_;
};

/// The way down from a pair of nodes to the pairs of children that overlap, or of the higher one's
/// children with the other.
template <std::size_t D>
class pair_traversal {
  public:
    explicit pair_traversal(const two_trees<D>& trees)
        : both_(trees.both_frames),
          a_{{*trees.a, trees.map_a}, {*trees.a, trees.own_a}},
          b_{{*trees.b, trees.map_b}, {*trees.b, trees.own_b}} {}

    [[nodiscard]] unsigned top_a() const { return a_.common.top(); }
    [[nodiscard]] unsigned top_b() const { return b_.common.top(); }
    [[nodiscard]] search_statistics& seen() { return seen_; }

    [[nodiscard]] node_location<D> at_a(unsigned height, std::size_t i) {
        return at(a_, height, i);
    }
    [[nodiscard]] node_location<D> at_b(unsigned height, std::size_t i) {
        return at(b_, height, i);
    }

    /// One step down from a pair of nodes whose boxes may overlap: `inner(a, b)` for each pair of
    /// nodes below, until it returns false; for two leaf blocks `leaf(i, mask)`, primitive i of a
    /// with each of `mask` of b.
    template <class Inner, class Leaf>
    bool open(const node_location<D>& a, const node_location<D>& b, const Inner& inner,
              const Leaf& leaf) {
        ++seen_.nodes;
        if (a.height < b.height) {
            const framed_node<D> node = node_at(b_, b);
            for (unsigned rest = mask(node, a.parent, a.slot); rest != 0; rest &= rest - 1)
                if (!inner(a, child(b, node, lowest(rest)))) return false;
            return true;
        }
        const framed_node<D> node_a = node_at(a_, a);
        const unsigned in_a = mask(node_a, b.parent, b.slot);
        if (b.height < a.height) {
            for (unsigned rest = in_a; rest != 0; rest &= rest - 1)
                if (!inner(child(a, node_a, lowest(rest)), b)) return false;
            return true;
        }
        if (in_a == 0) return true;
        const framed_node<D> node_b = node_at(b_, b);
        std::array<unsigned, 8> in_b;
        const unsigned met = masks(node_b, node_a, in_a, in_b);
        if (a.height == 0) {
            for (unsigned i = met; i != 0; i &= i - 1) leaf(lowest(i), in_b[lowest(i)]);
            return true;
        }
        prefetch_children(a, met, b, in_b);
        for (unsigned i = met; i != 0; i &= i - 1) {
            const node_location<D> below = child(a, node_a, lowest(i));
            for (unsigned rest = in_b[lowest(i)]; rest != 0; rest &= rest - 1)
                if (!inner(below, child(b, node_b, lowest(rest)))) return false;
        }
        return true;
    }

    /// All candidates below two nodes, until the sink is asked to stop.
    bool descend(const node_location<D>& a, const node_location<D>& b, candidate_sink& sink) {
        return open(
                   a, b,
                   [&](const node_location<D>& x, const node_location<D>& y) {
                       return descend(x, y, sink);
                   },
                   [&](std::size_t i, unsigned in_b) {
                       sink.add(static_cast<std::uint32_t>(8 * a.node + i),
                                static_cast<std::uint32_t>(8 * b.node), in_b);
                   }) &&
               !sink.stopped();
    }

  private:
    /// A tree in the common frame and in the other one.
    struct side {
        framed_nodes<D> common;
        framed_nodes<D> own;
    };

    static std::size_t lowest(unsigned bits) {
        return static_cast<std::size_t>(std::countr_zero(bits));
    }
    static node_location<D> child(const node_location<D>& of, const framed_node<D>& node,
                                  std::size_t slot) {
        return {of.height - 1, 8 * of.node + slot, node, slot};
    }
    [[nodiscard]] framed_node<D> node_at(side& of, const node_location<D>& at) const {
        return {&of.common.node(at.height, at.node),
                both_ ? &of.own.node(at.height, at.node) : nullptr};
    }
    [[nodiscard]] node_location<D> at(side& of, unsigned height, std::size_t i) const {
        return {height,
                i,
                {of.common.above(height, i), both_ ? of.own.above(height, i) : nullptr},
                height == of.common.top() ? 0 : i % 8};
    }
    /// The children of a that have a pair, and their partners, are about to be opened.
    void prefetch_children(const node_location<D>& a, unsigned in_a, const node_location<D>& b,
                           const std::array<unsigned, 8>& in_b) {
        unsigned partners = 0;
        for (unsigned i = in_a; i != 0; i &= i - 1) {
            partners |= in_b[lowest(i)];
            a_.common.prefetch(a.height - 1, 8 * a.node + lowest(i));
        }
        for (unsigned rest = partners; rest != 0; rest &= rest - 1)
            b_.common.prefetch(b.height - 1, 8 * b.node + lowest(rest));
        for (unsigned i = in_a; i != 0; i &= i - 1) {
            a_.common.node(a.height - 1, 8 * a.node + lowest(i));
            if (both_) a_.own.node(a.height - 1, 8 * a.node + lowest(i));
        }
        for (unsigned i = partners; i != 0; i &= i - 1) {
            b_.common.node(b.height - 1, 8 * b.node + lowest(i));
            if (both_) b_.own.node(b.height - 1, 8 * b.node + lowest(i));
        }
    }
    unsigned mask(const framed_node<D>& node, const framed_node<D>& other, std::size_t slot) {
        ++seen_.box_tests;
        const unsigned overlapping = overlap_mask(*node.common, *other.common, slot);
        if (!both_ || overlapping == 0) return overlapping;
        assert(node.own != nullptr && other.own != nullptr);
        return overlapping & overlap_mask(*node.own, *other.own, slot);
    }
    /// The masks of `node` for the slots of `other` in `wanted`; returns those where it is not 0.
    unsigned masks(const framed_node<D>& node, const framed_node<D>& other, unsigned wanted,
                   std::array<unsigned, 8>& overlapping) {
        seen_.box_tests += static_cast<unsigned>(std::popcount(wanted));
        overlapping.fill(0xFF);
        wanted = overlap_masks(*node.common, *other.common, wanted, overlapping.data());
        if (!both_ || wanted == 0) return wanted;
        assert(node.own != nullptr && other.own != nullptr);
        return overlap_masks(*node.own, *other.own, wanted, overlapping.data());
    }

    bool both_;
    side a_;
    side b_;
    search_statistics seen_;
};

/// Pairs of nodes deep enough that there are `enough` of them, in the order the serial search
/// meets them.
template <std::size_t D>
frontier expand(const two_trees<D>& trees, std::size_t enough) {
    pair_traversal<D> traversal(trees);
    frontier now{traversal.top_a(), traversal.top_b(), {{0, 0}}};
    while (now.height_a + now.height_b != 0 && !now.items.empty() && now.items.size() < enough) {
        std::vector<node_pair> below;
        for (const node_pair item : now.items)
            traversal.open(
                traversal.at_a(now.height_a, item.a), traversal.at_b(now.height_b, item.b),
                [&](const node_location<D>& a, const node_location<D>& b) {
                    below.push_back(
                        {static_cast<std::uint32_t>(a.node), static_cast<std::uint32_t>(b.node)});
                    return true;
                },
                [](std::size_t, unsigned) {});
        const unsigned height = std::max(now.height_a, now.height_b) - 1;
        now.height_a = std::min(now.height_a, height);
        now.height_b = std::min(now.height_b, height);
        now.items = std::move(below);
    }
    return now;
}

template <std::size_t D>
search_statistics search_items(const two_trees<D>& trees, unsigned height_a, unsigned height_b,
                               std::span<const node_pair> items, std::size_t block_size,
                               block_visitor visit) {
    candidate_sink sink(visit, block_size);
    pair_traversal<D> traversal(trees);
    for (std::size_t i = 0; i < items.size() && !sink.stopped(); ++i)
        traversal.descend(traversal.at_a(height_a, items[i].a),
                          traversal.at_b(height_b, items[i].b), sink);
    sink.flush();
    traversal.seen().candidates = sink.total();
    return traversal.seen();
}

frontier expand_2(const two_trees<2>& trees, std::size_t enough) { return expand(trees, enough); }
frontier expand_3(const two_trees<3>& trees, std::size_t enough) { return expand(trees, enough); }
search_statistics search_items_2(const two_trees<2>& trees, unsigned height_a, unsigned height_b,
                                 std::span<const node_pair> items, std::size_t block_size,
                                 block_visitor visit) {
    return search_items(trees, height_a, height_b, items, block_size, visit);
}
search_statistics search_items_3(const two_trees<3>& trees, unsigned height_a, unsigned height_b,
                                 std::span<const node_pair> items, std::size_t block_size,
                                 block_visitor visit) {
    return search_items(trees, height_a, height_b, items, block_size, visit);
}

}  // namespace
}  // namespace treeform::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace treeform {
namespace detail {
namespace {

HWY_EXPORT(expand_2);
HWY_EXPORT(expand_3);
HWY_EXPORT(search_items_2);
HWY_EXPORT(search_items_3);

frontier expand(const two_trees<2>& trees, std::size_t enough) {
    return HWY_DYNAMIC_DISPATCH(expand_2)(trees, enough);
}
frontier expand(const two_trees<3>& trees, std::size_t enough) {
    return HWY_DYNAMIC_DISPATCH(expand_3)(trees, enough);
}
search_statistics search_items(const two_trees<2>& trees, unsigned height_a, unsigned height_b,
                               std::span<const node_pair> items, std::size_t block_size,
                               block_visitor visit) {
    return HWY_DYNAMIC_DISPATCH(search_items_2)(trees, height_a, height_b, items, block_size,
                                                visit);
}
search_statistics search_items(const two_trees<3>& trees, unsigned height_a, unsigned height_b,
                               std::span<const node_pair> items, std::size_t block_size,
                               block_visitor visit) {
    return HWY_DYNAMIC_DISPATCH(search_items_3)(trees, height_a, height_b, items, block_size,
                                                visit);
}

template <std::size_t D>
two_trees<D> in_one_frame(const transformed<D>& a, const transformed<D>& b, bool in_both_frames) {
    const tree_frame<D>& frame_a = a.original().frame();
    const tree_frame<D>& frame_b = b.original().frame();
    const tree_frame<D> common = common_frame(frame_a, a.map(), frame_b, b.map());
    two_trees<D> trees{&a.original(), &b.original(), map_into(frame_a, a.map(), common),
                       map_into(frame_b, b.map(), common)};
    if (!in_both_frames || a.is_moved() == b.is_moved() || a.original().empty() ||
        b.original().empty())
        return trees;
    const auto back = a.is_moved() ? map_back(frame_b, a.map(), a.original())
                                   : map_back(frame_a, b.map(), b.original());
    trees.both_frames = back.has_value();
    if (back) (a.is_moved() ? trees.own_b : trees.own_a) = *back;
    return trees;
}

// Where the search is cut: at the first level with enough pairs of nodes, in pieces of a few. Both
// follow from the trees alone, so that results do. Fewer pieces of small trees, as each costs a
// third of a microsecond, and the cut is made by one thread.
std::size_t enough_items(std::size_t primitives) {
    return std::clamp<std::size_t>(primitives / 4096, 128, 1024);
}
constexpr std::size_t items_per_chunk = 4;
constexpr std::size_t full_block = max_candidates - 8;
constexpr std::size_t small_block = 56;

}  // namespace
}  // namespace detail

template <std::size_t D>
pair_search_chunks<D>::pair_search_chunks(const transformed<D>& a, const transformed<D>& b,
                                          bool in_both_frames)
    : trees_(detail::in_one_frame(a, b, in_both_frames)) {
    if (trees_.a->empty() || trees_.b->empty()) return;
    detail::frontier cut =
        detail::expand(trees_, detail::enough_items(trees_.a->size() + trees_.b->size()));
    height_a_ = cut.height_a;
    height_b_ = cut.height_b;
    items_ = std::move(cut.items);
}

template <std::size_t D>
std::size_t pair_search_chunks<D>::chunks() const {
    return chunk_count(items_.size(), detail::items_per_chunk);
}

template <std::size_t D>
search_statistics pair_search_chunks<D>::visit(
    std::size_t chunk, detail::function_ref<bool(const candidate_block&)> visit) const {
    const std::size_t begin = chunk * detail::items_per_chunk;
    const std::size_t count = std::min(detail::items_per_chunk, items_.size() - begin);
    return detail::search_items(trees_, height_a_, height_b_,
                                std::span(items_).subspan(begin, count), detail::full_block, visit);
}

template <std::size_t D>
search_statistics pair_search_chunks<D>::visit_all(
    const transformed<D>& a, const transformed<D>& b,
    detail::function_ref<bool(const candidate_block&)> visit, bool in_both_frames) {
    if (a.original().empty() || b.original().empty()) return {};
    const detail::two_trees<D> trees = detail::in_one_frame(a, b, in_both_frames);
    const detail::node_pair roots{0, 0};
    return detail::search_items(trees, trees.a->levels() - 1, trees.b->levels() - 1, {&roots, 1},
                                detail::small_block, visit);
}

template class pair_search_chunks<2>;
template class pair_search_chunks<3>;

}  // namespace treeform
#endif
