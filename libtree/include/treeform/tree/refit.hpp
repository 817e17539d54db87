#pragma once
/// \file
/// Updates a tree whose primitives have moved: new boxes in the same leaf order.

#include <treeform/tree/build.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/detail/node_bounds.hpp>
#include <treeform/tree/detail/refit_levels.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <ranges>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace treeform {

/// [N] the position of each primitive in leaf order: the inverse of `tree.ids()`.
///
/// \pre  the tree has no empty slots (`build` makes none)
/// \same on any number of threads
template <std::size_t D>
[[nodiscard]] TREEFORM_API std::vector<std::uint32_t> leaf_positions(const tree<D>& tree);

/// How expensive a tree is to search: the sum of the extents of all node boxes, divided by the
/// extents of the root. This is the number of nodes that a random plane (in 2D: line) through the
/// root's box opens on average. 1 for a tree of one node, or if all primitives are the same point.
///
/// Divide it by the value after the last build: searches open about that many times as many nodes.
/// From a ratio of 1.3 on, a rebuild pays off after a few searches that visit the whole tree.
///
/// \cost O(N), to read a box for every 8 primitives
/// \same on any number of threads
/// \source Crofton: the measure of the planes that meet a convex body is its mean width, for a box
///         proportional to the sum of its extents. Goldsmith and Salmon, Automatic Creation of
///         Object Hierarchies for Ray Tracing, IEEE CG&A 7 (1987), for lines
template <std::size_t D>
[[nodiscard]] TREEFORM_API double search_cost(const tree<D>& tree);

namespace detail {

template <std::size_t D, class Range>
void check_size(const tree<D>& tree, const Range& range) {
    const auto size = static_cast<std::size_t>(std::ranges::distance(range));
    if (size != tree.size())
        throw std::invalid_argument("treeform::refit: " + std::to_string(size) +
                                    " elements for a tree of " + std::to_string(tree.size()));
}

[[noreturn]] inline void refuse_refit(std::size_t element) {
    throw std::invalid_argument("treeform::refit: the box of element " + std::to_string(element) +
                                " is empty or not finite");
}

/// Calls `write(writer, i)` for i in [0, count), which `put`s boxes until one is invalid, and
/// `lift_blocks(begin, end)` after each chunk, while its leaf blocks are in the cache. Returns the
/// lowest primitive at which a chunk stopped, or `no_primitive`.
template <std::size_t D, class Write, class Lift>
[[nodiscard]] std::uint32_t write_in_chunks(tree<D>& tree, std::size_t count, std::size_t grain,
                                            const Write& write, const Lift& lift_blocks) {
    std::vector<std::uint32_t> bad(chunk_count(count, grain), no_primitive);
    for_chunks(count, grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        slot_writer<D> writer(tree);
        bool sound = true;
        for (std::size_t i = begin; i < end && sound; ++i) sound = write(writer, i);
        if (!sound || !writer.flush()) bad[chunk] = tree.ids()[writer.bad_place()];
        lift_blocks(begin, end);
    });
    return bad.empty() ? no_primitive : *std::min_element(bad.begin(), bad.end());
}

/// The boxes of the elements of a range, requested in leaf order.
template <class Range, class MakeBox>
struct element_boxes {
    const Range& range;
    const MakeBox& make_aabb;

    decltype(auto) element(std::size_t i) const {
        return std::ranges::begin(
            range)[static_cast<std::ranges::range_difference_t<const Range>>(i)];
    }
    auto operator()(std::uint32_t id) const { return make_aabb(element(id)); }

    /// Elements may be anywhere in memory; those that are objects are prefetched.
    void prefetch(std::uint32_t id) const {
        if constexpr (std::is_lvalue_reference_v<decltype(element(id))>) {
            const char* const first = reinterpret_cast<const char*>(std::addressof(element(id)));
            __builtin_prefetch(first);
            __builtin_prefetch(first + sizeof(element(id)) - 1);
        }
    }
};
template <class Range, class MakeBox>
element_boxes(const Range&, const MakeBox&) -> element_boxes<Range, MakeBox>;

/// Writes all boxes and updates the levels above. Returns as `write_in_chunks`.
template <std::size_t D, class BoxOf>
[[nodiscard]] std::uint32_t refit_all(tree<D>& tree, const BoxOf& box_of) {
    constexpr std::size_t ahead = 24;
    const std::span<const std::uint32_t> ids = tree.ids();
    const std::uint32_t bad = write_in_chunks(
        tree, tree.size(), std::size_t{1} << 13,
        [&](slot_writer<D>& writer, std::size_t position) {
            if (position + ahead < ids.size()) box_of.prefetch(ids[position + ahead]);
            return writer.put(static_cast<std::uint32_t>(position), box_of(ids[position]));
        },
        [&](std::size_t begin, std::size_t end) {
            if (tree.levels() == 1) return;
            for (std::size_t block = begin / 8; 8 * block < end; ++block)
                lift(tree, tree.levels() - 1, block);
        });
    lift_inner(tree);
    return bad;
}

/// Calls `visit(position)` for the positions of `slots` until it returns false; returns false in
/// that case, else true.
template <class Visit>
bool for_positions(const leaf_slots& slots, const Visit& visit) {
    for (unsigned rest = slots.slots; rest != 0; rest &= rest - 1)
        if (!visit(8 * slots.block + static_cast<std::uint32_t>(std::countr_zero(rest))))
            return false;
    return true;
}

/// The same for the primitives in `slots` only; slots without a primitive are emptied.
template <std::size_t D, class BoxOf>
[[nodiscard]] std::uint32_t refit_slots(tree<D>& tree, std::span<const leaf_slots> slots,
                                        const BoxOf& box_of) {
    constexpr std::size_t ahead = 12;
    const std::span<const std::uint32_t> ids = tree.ids();
    wide_node<D>* const leaves = tree.level_data(tree.levels() - 1);
    const auto prefetch = [&](const leaf_slots& later) {
        const char* const leaf = reinterpret_cast<const char*>(leaves + later.block);
        for (std::size_t line = 0; line < sizeof(wide_node<D>); line += 64)
            __builtin_prefetch(leaf + line, 1);
        for_positions(later, [&](std::uint32_t position) {
            if (ids[position] != no_primitive) box_of.prefetch(ids[position]);
            return true;
        });
    };
    const std::uint32_t bad = write_in_chunks(
        tree, slots.size(), 1024,
        [&](slot_writer<D>& writer, std::size_t i) {
            if (i + ahead < slots.size()) prefetch(slots[i + ahead]);
            return for_positions(slots[i], [&](std::uint32_t position) {
                if (ids[position] != no_primitive)
                    return writer.put(position, box_of(ids[position]));
                clear_slot(leaves[position / 8], position % 8);
                return true;
            });
        },
        [&](std::size_t begin, std::size_t end) {
            if (tree.levels() == 1) return;
            for (std::size_t i = begin; i < end; ++i) lift(tree, tree.levels() - 1, slots[i].block);
        });
    lift_inner(tree, slots);
    return bad;
}

}  // namespace detail

/// Replaces the box of every primitive of `tree` by the one that `make_aabb` returns for its
/// element of `range`. The leaf order and the frame do not change. Searches are correct for any
/// boxes, and as fast as before if neighbors stay neighbors (see `search_cost`). With unchanged
/// boxes, the tree does not change.
///
/// \throws std::invalid_argument if the size of the range differs from that of the tree; naming an
///         element whose box is not finite or is empty. Some other elements then have their new
///         boxes; a refit with valid boxes makes the tree valid again
/// \cost   O(N), about a third of a build
/// \same   on any number of threads; `make_aabb` is called once for each element
/// \source van den Bergen, Efficient Collision Detection of Complex Deformable Models using AABB
///         Trees, JGT 2 (1997)
template <std::size_t D, std::ranges::random_access_range Range, class MakeBox>
requires box_maker<MakeBox, std::ranges::range_reference_t<const Range>>
void refit(tree<D>& tree, const Range& range, const MakeBox& make_aabb) {
    detail::check_size(tree, range);
    const std::uint32_t bad = detail::refit_all(tree, detail::element_boxes{range, make_aabb});
    if (bad != detail::no_primitive) detail::refuse_refit(bad);
}

/// The same only for the primitives at `positions` of the leaf order (`leaf_positions`); all
/// others keep their boxes. Positions may be in any order, and may repeat.
///
/// \throws std::invalid_argument also naming a position out of range; the tree is then unchanged
/// \cost   O(P log N) for P positions and their ancestors; if P is above N / 128, also a pass over
///         N / 8 bytes
template <std::size_t D, std::ranges::random_access_range Range, class MakeBox>
requires box_maker<MakeBox, std::ranges::range_reference_t<const Range>>
void refit(tree<D>& tree, const Range& range, const MakeBox& make_aabb,
           std::span<const std::uint32_t> positions) {
    detail::check_size(tree, range);
    for (const std::uint32_t position : positions)
        if (position >= tree.size())
            throw std::invalid_argument("treeform::refit: position " + std::to_string(position) +
                                        " is not in the tree");
    const std::vector<detail::leaf_slots> slots = detail::slots_at(positions, tree.size());
    const std::uint32_t bad =
        detail::refit_slots<D>(tree, slots, detail::element_boxes{range, make_aabb});
    if (bad != detail::no_primitive) detail::refuse_refit(bad);
}

}  // namespace treeform
