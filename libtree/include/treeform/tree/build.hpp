#pragma once
/// \file
/// Builds a tree over any range of elements that have boxes. Checks the invariants of a tree.

#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/build_records.hpp>
#include <treeform/tree/detail/frame.hpp>
#include <treeform/tree/detail/round_boxes.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <ranges>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace treeform {

/// A selection algorithm for `build`: `partition(first, nth, last, less)` reorders [first, last) so
/// that no element before `nth` is greater than an element after it.
template <class S>
concept partition_strategy = requires(int* first, int* nth, int* last,
                                      bool (*less)(const int&, const int&)) {
    S::partition(first, nth, last, less);
};

/// Makes the box of an element: returns a `treeform::aabb<T, D>` of float or double, D = 2 or 3.
template <class F, class Element>
concept box_maker = requires(const F& make_aabb, Element element) {
    { make_aabb(element).min.size() } -> std::convertible_to<std::size_t>;
};

/// Builds trees, and keeps its memory between builds: 24 bytes for each element of the largest
/// build. Must not be used by two threads at once. After a build that throws, `tree` must be
/// rebuilt before it is searched.
template <std::size_t D>
class builder {
  public:
    /// Replaces `tree` by the tree over `range`. See `build`.
    template <class Strategy = detail::bracketed_select, std::ranges::input_range Range,
              class MakeBox>
    void rebuild(tree<D>& tree, Range&& range, const MakeBox& make_aabb);

  private:
    template <class Range, class MakeBox>
    void run(tree<D>& tree, Range& range, const MakeBox& make_aabb,
             const detail::select_records* select);
    template <class Range, class MakeBox>
    void fill(tree<D>& tree, const Range& range, const MakeBox& make_aabb,
              const detail::select_records* select);

    detail::build_memory memory_;
};

/// The tree over the boxes that `make_aabb` gives for the elements of `range`.
///
/// The tree keeps boxes rounded outward to float, in a frame chosen from the data (`tree_frame`).
/// They are only used for pruning. Elements are halved by their number, along the axis on which
/// their centers spread most, so many equal centers do no harm.
///
/// `Strategy` is the selection algorithm: the default, or any `partition_strategy`.
///
/// \throws std::invalid_argument naming an element whose box is not finite or is empty; if the
///         range has more than `tree<D>::max_size` elements
/// \cost   O(N log N) expected time. With D = 3, about 56 bytes an element at the peak, of which
///         the tree keeps 32; plus the boxes of a range without random access
/// \same   on any number of threads. A random-access range of known size is read in parallel:
///         `make_aabb` is called up to twice for each element, by several threads at once. Any
///         other range is read once, in order
/// \source Sajovic, Knez and Korez, tf::tree, Algorithm 1; the selection after Floyd and Rivest
template <class Strategy = detail::bracketed_select, std::ranges::input_range Range, class MakeBox>
requires box_maker<MakeBox, std::ranges::range_reference_t<Range>>
[[nodiscard]] auto build(Range&& range, const MakeBox& make_aabb) {
    using box = std::remove_cvref_t<decltype(make_aabb(*std::ranges::begin(range)))>;
    tree<box::dimensions> result;
    builder<box::dimensions>{}.template rebuild<Strategy>(result, std::forward<Range>(range),
                                                          make_aabb);
    return result;
}

/// The same with the strategy as a value: `build(my_selection{}, ...)`.
template <class Strategy, std::ranges::input_range Range, class MakeBox>
requires box_maker<MakeBox, std::ranges::range_reference_t<Range>>
[[nodiscard]] auto build(Strategy, Range&& range, const MakeBox& make_aabb) {
    return build<Strategy>(std::forward<Range>(range), make_aabb);
}

template <std::size_t D>
template <class Strategy, std::ranges::input_range Range, class MakeBox>
void builder<D>::rebuild(tree<D>& tree, Range&& range, const MakeBox& make_aabb) {
    if constexpr (std::is_same_v<Strategy, detail::bracketed_select>) {
        run(tree, range, make_aabb, nullptr);
    } else {
        static_assert(partition_strategy<Strategy>);
        using record = detail::split_record;
        const auto select = [](record* first, record* nth, record* last, int axis) {
            Strategy::partition(first, nth, last, [axis](const record& a, const record& b) {
                return a.center[axis] < b.center[axis];
            });
        };
        const detail::select_records by_reference = select;
        run(tree, range, make_aabb, &by_reference);
    }
}

template <std::size_t D>
template <class Range, class MakeBox>
void builder<D>::run(tree<D>& tree, Range& range, const MakeBox& make_aabb,
                     const detail::select_records* select) {
    if constexpr (std::ranges::random_access_range<Range> && std::ranges::sized_range<Range>) {
        fill(tree, range, make_aabb, select);
    } else {  // read once, in order
        using box = std::remove_cvref_t<decltype(make_aabb(*std::ranges::begin(range)))>;
        std::vector<box> boxes;
        for (auto&& element : range) boxes.push_back(make_aabb(element));
        fill(
            tree, boxes, [](const box& b) -> const box& { return b; }, select);
    }
    detail::build_from_records(tree, memory_, select);
}

template <std::size_t D>
template <class Range, class MakeBox>
void builder<D>::fill(tree<D>& tree, const Range& range, const MakeBox& make_aabb,
                      const detail::select_records* select) {
    const auto first = std::ranges::begin(range);
    const auto size = static_cast<std::size_t>(std::ranges::size(range));
    if (size > treeform::tree<D>::max_size)
        throw std::invalid_argument("treeform::build: " + std::to_string(size) +
                                    " elements are too many");
    const auto box_of = [&](std::size_t i) {
        return make_aabb(first[static_cast<std::ranges::range_difference_t<Range>>(i)]);
    };
    tree.reset(size);
    tree.set_frame(detail::frame_of<D>(size, box_of));
    detail::split_record* const records = detail::records_of(tree, memory_, select);
    memory_.extents.resize(size);
    std::atomic<std::size_t> bad{size};  // the first element whose box cannot be used
    using block = detail::box_block<D>;
    for_chunks(size, std::size_t{1} << 11, [&](std::size_t begin, std::size_t end, std::size_t) {
        block boxes;
        for (std::size_t i = begin; i < end; i += block::size) {
            const std::size_t count = std::min(block::size, end - i);
            for (std::size_t j = 0; j < count; ++j) boxes.set(j, box_of(i + j));
            const std::size_t sound =
                detail::round_boxes(tree.frame(), boxes, count, static_cast<std::uint32_t>(i),
                                    records + i, memory_.extents.data() + i);
            if (sound == count) continue;
            std::size_t seen = bad.load();
            while (i + sound < seen && !bad.compare_exchange_weak(seen, i + sound)) {
            }
            return;
        }
    });
    if (bad.load() != size)
        throw std::invalid_argument("treeform::build: the box of element " +
                                    std::to_string(bad.load()) + " is empty or not finite");
}

namespace detail {

/// Whether `ids` contains each of 0 ... N-1 once.
[[nodiscard]] inline bool is_permutation(std::span<const std::uint32_t> ids) {
    std::vector<bool> seen(ids.size(), false);
    for (const std::uint32_t id : ids) {
        if (id >= ids.size() || seen[id]) return false;
        seen[id] = true;
    }
    return true;
}

/// Whether slot `slot` of `node` contains `box`, in the frame of the tree.
template <class T, std::size_t D>
[[nodiscard]] bool slot_holds(const wide_node<D>& node, std::size_t slot, const aabb<T, D>& box,
                              const tree_frame<D>& frame) {
    // The exact image of the box differs from the computed one by at most one rounding; a slot that
    // contains the computed box without slack was not rounded outward. An infinite side contains
    // everything, even values that overflow here.
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (std::size_t k = 0; k < D; ++k) {
        const double lo = (static_cast<double>(box.min[k]) - frame.origin[k]) * frame.scale;
        const double hi = (static_cast<double>(box.max[k]) - frame.origin[k]) * frame.scale;
        const float min = node.min[k][slot], max = node.max[k][slot];
        if (!(static_cast<double>(min) < lo) && min != -infinity) return false;
        if (!(static_cast<double>(max) > hi) && max != infinity) return false;
    }
    return true;
}

}  // namespace detail

/// The reason why `tree` is not a valid tree over `boxes`, or none. In a valid tree the ids are a
/// permutation, every leaf slot contains the box of its primitive, every inner slot is exactly the
/// box around the boxes of its child, and no other slot is in use.
template <std::size_t D, class T>
[[nodiscard]] std::optional<std::string> why_malformed(const tree<D>& tree,
                                                       std::span<const aabb<T, D>> boxes) {
    const auto at = [](const char* what, unsigned level, std::size_t node, std::size_t slot) {
        return std::string(what) + " at level " + std::to_string(level) + ", node " +
               std::to_string(node) + ", slot " + std::to_string(slot);
    };
    if (tree.size() != boxes.size() || tree.ids().size() != boxes.size()) return "wrong size";
    if (!detail::is_permutation(tree.ids())) return "ids are not a permutation";
    if (tree.empty()) return std::nullopt;
    const auto is_clear = [](const wide_node<D>& node, std::size_t slot) {
        for (std::size_t k = 0; k < D; ++k)
            if (!(node.min[k][slot] > node.max[k][slot])) return false;
        return true;
    };
    for (unsigned level = 0; level < tree.levels(); ++level)
        for (std::size_t n = 0; n < tree.nodes_in_level(level); ++n) {
            const wide_node<D>& node = tree.level(level)[n];
            const bool leaf = tree.is_leaf_level(level);
            const std::size_t used = tree.child_count(level, n);
            for (std::size_t slot = 0; slot < tree.width; ++slot) {
                if (slot >= used) {
                    if (!is_clear(node, slot)) return at("slot should be empty", level, n, slot);
                } else if (leaf) {
                    const aabb<T, D>& box = boxes[tree.ids()[n * tree.width + slot]];
                    if (!detail::slot_holds(node, slot, box, tree.frame()))
                        return at("box is smaller than its primitive", level, n, slot);
                } else {
                    const wide_node<D>& child = tree.level(level + 1)[n * tree.width + slot];
                    for (std::size_t k = 0; k < D; ++k)
                        if (node.min[k][slot] !=
                                *std::min_element(child.min[k], child.min[k] + tree.width) ||
                            node.max[k][slot] !=
                                *std::max_element(child.max[k], child.max[k] + tree.width))
                            return at("box differs from that of the children", level, n, slot);
                }
            }
        }
    return std::nullopt;
}

}  // namespace treeform
