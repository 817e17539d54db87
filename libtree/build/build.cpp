#include <libtree/build/multiway_partition.hpp>
#include <treeform/tree/detail/build_records.hpp>
#include <treeform/tree/detail/node_bounds.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <utility>
#include <vector>

namespace treeform::detail {
namespace {

// Work is cut by these sizes, never by the thread count. A part above `shared_split` records is cut
// by all threads together; below `subtree` records one thread takes the part to its leaves.
constexpr std::size_t shared_split = std::size_t{1} << 16;
constexpr std::size_t subtree = std::size_t{1} << 12;

/// The memory of the nodes, which hold nothing yet, as a second array of records: each leaf block
/// has room for more than the 8 records it gets.
template <std::size_t D>
split_record* scratch_of(tree<D>& tree) {
    static_assert(sizeof(wide_node<D>) >= treeform::tree<D>::width * sizeof(split_record));
    return ::new (static_cast<void*>(tree.level_data(0)))
        split_record[std::max<std::size_t>(tree.size(), 1)];
}

/// Appends what `part` is cut into after `rounds` rounds.
void append_cut(const split_plan& plan, const split_part& part, unsigned rounds,
                std::vector<split_part>& to) {
    if (rounds == 0) return to.push_back(part);
    const auto [begin, count, round] = part;
    const std::size_t left = plan.left(count, round);
    append_cut(plan, {begin, left, round + 1}, rounds - 1, to);
    if (left < count) append_cut(plan, {begin + left, count - left, round + 1}, rounds - 1, to);
}

/// The parts, those above `grain` records after `rounds` more rounds.
std::vector<split_part> cut_above(const split_plan& plan, const std::vector<split_part>& parts,
                                  std::size_t grain, unsigned rounds) {
    std::vector<split_part> result;
    for (const split_part& part : parts)
        append_cut(plan, part, part.count > grain ? rounds : 0, result);
    return result;
}

bool exceeds(const std::vector<split_part>& parts, std::size_t grain) {
    return std::any_of(parts.begin(), parts.end(),
                       [&](const split_part& part) { return part.count > grain; });
}

/// Cuts parts down to leaf blocks. They are independent: each is one thread's, in `cut(part)` down
/// to the grain of a task and in `finish(part)` from there on.
template <class Cut, class Finish>
void cut_parts(const split_plan& plan, std::vector<split_part> parts, const Cut& cut,
               const Finish& finish) {
    for (; exceeds(parts, subtree); parts = cut_above(plan, parts, subtree, 1))
        for_chunks(parts.size(), 1, [&](std::size_t i, std::size_t, std::size_t) {
            if (parts[i].count > subtree) cut(parts[i]);
        });
    for_chunks(parts.size(), 1, [&](std::size_t i, std::size_t, std::size_t) { finish(parts[i]); });
}

/// Sorts the records into leaf order, from one array to the other in each round; they end up in
/// `memory.records`.
template <std::size_t D>
void order_by_splits(const split_plan& plan, tree<D>& tree, build_memory& memory) {
    split_record* even = memory.records.data();
    split_record* odd = scratch_of(tree);
    if (plan.rounds() % 2 != 0) std::swap(even, odd);
    const auto from = [&](const split_part& p) {
        return (p.round % 2 == 0 ? even : odd) + p.begin;
    };
    const auto to = [&](const split_part& p) { return (p.round % 2 == 0 ? odd : even) + p.begin; };
    std::vector<split_part> parts{{0, plan.size, 0}};
    for (; exceeds(parts, shared_split);
         parts = cut_above(plan, parts, shared_split, partition_rounds))
        for (const split_part& part : parts)
            if (part.count > shared_split) multiway_partition(from(part), to(part), plan, part);
    cut_parts(
        plan, std::move(parts),
        [&](const split_part& part) {
            const std::size_t left = plan.left(part.count, part.round);
            if (left == part.count)
                std::copy_n(from(part), part.count, to(part));
            else
                split(from(part), to(part), part.count, left);
        },
        [&](const split_part& part) { split_to_leaves(even, odd, plan, part); });
}

/// The same with a selection of the caller's, in place.
void order_by_selection(const split_plan& plan, build_memory& memory,
                        const select_records& select) {
    const auto cut = [&](const split_part& part) {
        split_record* const first = memory.records.data() + part.begin;
        const std::size_t left = plan.left(part.count, part.round);
        if (left == part.count) return;
        const split_axis axis = widest_axis(range_of(first, part.count));
        select(first, first + left, first + part.count, axis.axis);
    };
    const auto finish = [&](const split_part& part) {
        std::vector<split_part> parts{part};
        for (; parts[0].round < plan.rounds(); parts = cut_above(plan, parts, 0, 1))
            for (const split_part& p : parts) cut(p);
    };
    cut_parts(plan, {{0, plan.size, 0}}, cut, finish);
}

template <std::size_t D>
void clear(wide_node<D>& node) {
    for (std::size_t k = 0; k < D; ++k) {
        std::fill_n(node.min[k], tree<D>::width, std::numeric_limits<float>::infinity());
        std::fill_n(node.max[k], tree<D>::width, -std::numeric_limits<float>::infinity());
    }
}

template <std::size_t D>
void fill_leaves(tree<D>& tree, const split_record* order, const half_extents* extents) {
    constexpr std::size_t ahead = 24;  // extents come from anywhere in memory: ask for them early
    wide_node<D>* const leaves = tree.level_data(tree.levels() - 1);
    std::uint32_t* const ids = tree.ids_data();
    for_chunks(tree.nodes_in_level(tree.levels() - 1), 256,
               [&](std::size_t first, std::size_t last, std::size_t) {
                   for (std::size_t block = first; block < last; ++block) {
                       wide_node<D>& leaf = leaves[block];
                       const std::size_t begin = tree.width * block;
                       const std::size_t end = begin + tree.child_count(tree.levels() - 1, block);
                       if (end - begin < tree.width) clear(leaf);
                       for (std::size_t i = begin; i < end; ++i) {
                           if (i + ahead < tree.size())
                               __builtin_prefetch(&extents[order[i + ahead].id]);
                           const auto& [center, id] = order[i];
                           const half_extents half = extents[id];
                           ids[i] = id;
                           for (std::size_t k = 0; k < D; ++k) {
                               leaf.min[k][i - begin] = center[k] - half.template on_axis<D>(k);
                               leaf.max[k][i - begin] = center[k] + half.template on_axis<D>(k);
                           }
                       }
                   }
               });
}

/// Boxes of the inner levels, each from the level below.
template <std::size_t D>
void fill_inner(tree<D>& tree) {
    for (unsigned level = tree.levels() - 1; level > 0; --level) {
        clear(tree.level_data(level - 1)[tree.nodes_in_level(level - 1) - 1]);
        for_chunks(tree.nodes_in_level(level), 512,
                   [&](std::size_t first, std::size_t last, std::size_t) {
                       for (std::size_t n = first; n < last; ++n) lift(tree, level, n);
                   });
    }
}

}  // namespace

template <std::size_t D>
split_record* records_of(tree<D>& tree, build_memory& memory, const select_records* select) {
    memory.records.resize(tree.size());
    const bool starts_in_scratch =
        select == nullptr && split_plan::of(tree.size(), tree.levels()).rounds() % 2 != 0;
    return starts_in_scratch ? scratch_of(tree) : memory.records.data();
}

template <std::size_t D>
void build_from_records(tree<D>& tree, build_memory& memory, const select_records* select) {
    const split_plan plan = split_plan::of(tree.size(), tree.levels());
    if (plan.rounds() > 0) {
        if (select == nullptr)
            order_by_splits(plan, tree, memory);
        else
            order_by_selection(plan, memory, *select);
    }
    fill_leaves(tree, memory.records.data(), memory.extents.data());
    fill_inner(tree);
}

template split_record* records_of(tree<2>&, build_memory&, const select_records*);
template split_record* records_of(tree<3>&, build_memory&, const select_records*);
template void build_from_records(tree<2>&, build_memory&, const select_records*);
template void build_from_records(tree<3>&, build_memory&, const select_records*);

}  // namespace treeform::detail
