#include <libtree/query/candidate_sink.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libtree/query/search_self.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Behind the two, as it is compiled for each target.
#include <libtree/query/overlap_mask-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::HWY_NAMESPACE {
namespace {

template <std::size_t D>
struct self_traversal {
    const tree<D>& t;
    const node_marks<D>* skipped;
    candidate_sink& sink;
    search_statistics seen{};

    /// All pairs between the primitives below two nodes of `level`; the box of b is box `slot` of
    /// its parent, and overlaps that of a.
    void pair(unsigned level, std::size_t a, std::size_t b, const wide_node<D>& parent_of_b,
              std::size_t slot) {
        const wide_node<D>& node_a = t.level(level)[a];
        const wide_node<D>& node_b = t.level(level)[b];
        ++seen.nodes;
        ++seen.box_tests;
        for (unsigned as = overlap_mask(node_a, parent_of_b, slot); as != 0; as &= as - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(as));
            const unsigned bs = overlap_mask(node_b, node_a, i);
            ++seen.box_tests;
            if (t.is_leaf_level(level))
                emit(t.width * a + i, t.width * b, bs);
            else
                for (unsigned rest = bs; rest != 0; rest &= rest - 1) {
                    const auto j = static_cast<std::size_t>(std::countr_zero(rest));
                    pair(level + 1, child(a, i), child(b, j), node_b, j);
                    if (sink.stopped()) return;
                }
        }
    }

    /// All pairs among the primitives below one node.
    void self(unsigned level, std::size_t a) {
        if (skipped != nullptr && (*skipped)(level, a)) return;
        const wide_node<D>& node = t.level(level)[a];
        const std::size_t count = t.child_count(level, a);
        ++seen.nodes;
        seen.box_tests += count;
        for (std::size_t i = 0; i < count; ++i) {
            const unsigned later = overlap_mask(node, node, i) & ~((2U << i) - 1);
            if (t.is_leaf_level(level)) {
                emit(t.width * a + i, t.width * a, later);
            } else {
                self(level + 1, child(a, i));
                for (unsigned rest = later; rest != 0; rest &= rest - 1) {
                    const auto j = static_cast<std::size_t>(std::countr_zero(rest));
                    pair(level + 1, child(a, i), child(a, j), node, j);
                    if (sink.stopped()) return;
                }
            }
        }
    }

    void visit(unsigned level, node_pair pair_of_nodes) {
        const auto [a, b] = pair_of_nodes;
        if (a == b) return self(level, a);
        pair(level, a, b, t.level(level - 1)[b / t.width], b % t.width);
    }

    void emit(std::size_t first, std::size_t second, unsigned mask) {
        if (mask != 0)
            sink.add(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(second), mask);
    }

    static std::size_t child(std::size_t node, std::size_t i) { return node * tree<D>::width + i; }
};

/// The overlapping node pairs of the level below, in the order the serial search meets them.
template <std::size_t D>
void descend(const tree<D>& t, const node_marks<D>* skipped, unsigned level,
             std::span<const node_pair> pairs, std::vector<node_pair>& below) {
    const auto push = [&](std::size_t a, std::size_t b) {
        below.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)});
    };
    for (const auto [a, b] : pairs) {
        if (a == b && skipped != nullptr && (*skipped)(level, a)) continue;
        const wide_node<D>& node_a = t.level(level)[a];
        const wide_node<D>& node_b = t.level(level)[b];
        for (std::size_t i = 0; i < t.child_count(level, a); ++i) {
            unsigned bs = overlap_mask(node_b, node_a, i);
            if (a == b) {
                push(a * t.width + i, a * t.width + i);
                bs &= ~((2U << i) - 1);
            }
            for (; bs != 0; bs &= bs - 1)
                push(a * t.width + i, b * t.width + static_cast<std::size_t>(std::countr_zero(bs)));
        }
    }
}

template <std::size_t D>
search_statistics search_items(const tree<D>& t, const node_marks<D>* skipped, unsigned level,
                               std::span<const node_pair> items, block_visitor visit) {
    candidate_sink sink(visit);
    self_traversal<D> traversal{t, skipped, sink};
    for (std::size_t i = 0; i < items.size() && !sink.stopped(); ++i)
        traversal.visit(level, items[i]);
    sink.flush();
    traversal.seen.candidates = sink.total();
    return traversal.seen;
}

void descend_2(const tree<2>& t, const node_marks<2>* skipped, unsigned level,
               std::span<const node_pair> pairs, std::vector<node_pair>& below) {
    descend(t, skipped, level, pairs, below);
}
void descend_3(const tree<3>& t, const detail::node_marks<3>* skipped, unsigned level,
               std::span<const node_pair> pairs, std::vector<node_pair>& below) {
    descend(t, skipped, level, pairs, below);
}
search_statistics search_items_2(const tree<2>& t, const node_marks<2>* skipped, unsigned level,
                                 std::span<const node_pair> items, block_visitor visit) {
    return search_items(t, skipped, level, items, visit);
}
search_statistics search_items_3(const tree<3>& t, const detail::node_marks<3>* skipped,
                                 unsigned level, std::span<const node_pair> items,
                                 block_visitor visit) {
    return search_items(t, skipped, level, items, visit);
}

}  // namespace
}  // namespace treeform::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace treeform {
namespace detail {
namespace {

HWY_EXPORT(descend_2);
HWY_EXPORT(descend_3);
HWY_EXPORT(search_items_2);
HWY_EXPORT(search_items_3);

void descend(const tree<2>& t, const node_marks<2>* skipped, unsigned level,
             std::span<const node_pair> pairs, std::vector<node_pair>& below) {
    HWY_DYNAMIC_DISPATCH(descend_2)(t, skipped, level, pairs, below);
}
void descend(const tree<3>& t, const detail::node_marks<3>* skipped, unsigned level,
             std::span<const node_pair> pairs, std::vector<node_pair>& below) {
    HWY_DYNAMIC_DISPATCH(descend_3)(t, skipped, level, pairs, below);
}
search_statistics search_items(const tree<2>& t, const node_marks<2>* skipped, unsigned level,
                               std::span<const node_pair> items, block_visitor visit) {
    return HWY_DYNAMIC_DISPATCH(search_items_2)(t, skipped, level, items, visit);
}
search_statistics search_items(const tree<3>& t, const detail::node_marks<3>* skipped,
                               unsigned level, std::span<const node_pair> items,
                               block_visitor visit) {
    return HWY_DYNAMIC_DISPATCH(search_items_3)(t, skipped, level, items, visit);
}

// Where the search is cut: at the first level with enough pairs of nodes, in pieces of a few. Both
// are constants, so that results depend on the tree alone.
constexpr std::size_t enough_items = 2048;
constexpr std::size_t items_per_chunk = 16;

}  // namespace
}  // namespace detail

template <std::size_t D>
self_search_chunks<D>::self_search_chunks(const tree<D>& tree, const detail::node_marks<D>* skipped)
    : tree_(&tree), skipped_(skipped) {
    if (tree.empty()) return;
    items_ = {{0, 0}};
    while (!tree.is_leaf_level(level_) && items_.size() < detail::enough_items) {
        std::vector<detail::node_pair> below;
        detail::descend(tree, skipped, level_, items_, below);
        if (below.empty()) break;
        items_ = std::move(below);
        ++level_;
    }
}

template <std::size_t D>
std::size_t self_search_chunks<D>::chunks() const {
    return chunk_count(items_.size(), detail::items_per_chunk);
}

template <std::size_t D>
search_statistics self_search_chunks<D>::visit(
    std::size_t chunk, detail::function_ref<bool(const candidate_block&)> visit) const {
    const std::size_t begin = chunk * detail::items_per_chunk;
    const std::size_t count = std::min(detail::items_per_chunk, items_.size() - begin);
    return detail::search_items(*tree_, skipped_, level_, std::span(items_).subspan(begin, count),
                                visit);
}

template class self_search_chunks<2>;
template class self_search_chunks<3>;

}  // namespace treeform
#endif
