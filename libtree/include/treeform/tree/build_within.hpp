#pragma once
/// \file
/// Trees over only those primitives whose boxes meet a given box.

#include <treeform/tree/aabb.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/detail/frame.hpp>
#include <treeform/tree/detail/round_boxes.hpp>
#include <treeform/tree/detail/search_chunks.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <ranges>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace treeform {

namespace detail {

inline constexpr std::size_t elements_per_chunk = std::size_t{1} << 13;

template <std::ranges::random_access_range Range>
[[nodiscard]] decltype(auto) element_at(const Range& range, std::size_t i) {
    return std::ranges::begin(range)[static_cast<std::ranges::range_difference_t<const Range>>(i)];
}

template <class Range, class MakeBox>
using box_made = std::remove_cvref_t<
    std::invoke_result_t<const MakeBox&, std::ranges::range_reference_t<const Range>>>;

template <std::floating_point T, std::size_t D>
[[nodiscard]] aabb<double, D> in_double(const aabb<T, D>& box) {
    aabb<double, D> result;
    for (std::size_t k = 0; k < D; ++k) {
        result.min[k] = static_cast<double>(box.min[k]);
        result.max[k] = static_cast<double>(box.max[k]);
    }
    return result;
}

/// Box `i` of a block.
template <std::size_t D>
[[nodiscard]] aabb<double, D> box_at(const box_block<D>& boxes, std::size_t i) {
    aabb<double, D> box;
    for (std::size_t k = 0; k < D; ++k) {
        box.min[k] = boxes.min[k][i];
        box.max[k] = boxes.max[k][i];
    }
    return box;
}

/// Calls `use(state, i, box)` for the elements of each chunk of `grain` in order, with the box of
/// element i in double, and returns the states. A block of boxes is computed before the first is
/// tested, so that no branch waits for an element from memory.
///
/// \throws std::invalid_argument naming the element whose box is not finite or is empty
template <class State, class Range, class MakeBox, class Use>
[[nodiscard]] std::vector<State> for_boxes(const char* function, const Range& range,
                                           const MakeBox& make_aabb, const Use& use,
                                           std::size_t grain = elements_per_chunk) {
    using block = box_block<box_made<Range, MakeBox>::dimensions>;
    const auto size = static_cast<std::size_t>(std::ranges::size(range));
    std::vector<State> states(chunk_count(size, grain));
    std::atomic<std::size_t> bad{size};
    for_chunks(size, grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        State mine{};
        block boxes;
        for (std::size_t first = begin; first < end; first += block::size) {
            const std::size_t count = std::min(block::size, end - first);
            for (std::size_t i = 0; i < count; ++i)
                boxes.set(i, make_aabb(element_at(range, first + i)));
            for (std::size_t i = 0; i < count; ++i) {
                const auto box = box_at(boxes, i);
                if (!is_finite(box)) return lower(bad, first + i);
                use(mine, first + i, box);
            }
        }
        states[c] = std::move(mine);
    });
    if (bad.load() != size)
        throw std::invalid_argument(std::string(function) + ": the box of element " +
                                    std::to_string(bad.load()) + " is empty or not finite");
    return states;
}

template <std::size_t D, class Range, class MakeBox>
[[nodiscard]] aabb<double, D> box_around(const char* function, const Range& range,
                                         const MakeBox& make_aabb) {
    using box = aabb<double, D>;
    box all;
    for (const box& part :
         for_boxes<box>(function, range, make_aabb,
                        [](box&mine, std::size_t, const box&one) { mine.include(one); }))
        all.include(part);
    return all;
}

/// Elements of a range that meet a box, ascending, and the box around them.
template <std::size_t D>
struct elements_within {
    std::vector<std::uint32_t> ids{};
    aabb<double, D> box{};
};

template <std::size_t D, class Range, class MakeBox>
[[nodiscard]] elements_within<D> find_within(const char* function, const Range& range,
                                             const MakeBox& make_aabb,
                                             const aabb<double, D>& within) {
    using found = elements_within<D>;
    const auto parts = for_boxes<found>(
        function, range, make_aabb, [&](found& mine, std::size_t i, const aabb<double, D>& box) {
            if (!overlaps(box, within)) return;
            mine.ids.push_back(static_cast<std::uint32_t>(i));
            mine.box.include(box);
        });
    found all;
    for (const found& part : parts) {
        all.ids.insert(all.ids.end(), part.ids.begin(), part.ids.end());
        all.box.include(part.box);
    }
    return all;
}

/// The tree over some elements of a range of `size`.
template <std::size_t D, class Range, class MakeBox>
[[nodiscard]] tree<D> tree_over(const std::vector<std::uint32_t>& kept, const Range& range,
                                const MakeBox& make_aabb) {
    tree<D> result =
        build(kept, [&](std::uint32_t id) { return make_aabb(element_at(range, id)); });
    std::uint32_t* const places = result.ids_data();
    for_chunks(kept.size(), elements_per_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t i = begin; i < end; ++i) places[i] = kept[places[i]];
               });
    return result;
}

template <std::size_t D, class Range>
void refuse_too_many(const char* function, const Range& range) {
    const auto size = static_cast<std::size_t>(std::ranges::size(range));
    if (size > tree<D>::max_size)
        throw std::invalid_argument(std::string(function) + ": " + std::to_string(size) +
                                    " elements are too many");
}

}  // namespace detail

/// The tree over the elements of `range` whose boxes meet `within` (touching counts). Its `ids()`
/// are positions in the whole range. A search for anything inside that box has the same result as
/// in a tree over all elements.
///
/// With an empty box the tree is empty; with an infinite box it has all elements.
///
/// \throws std::invalid_argument as `build`, also for elements outside the box; if `within` has a
///         NaN coordinate
/// \cost   O(N), parallel, with one call of `make_aabb` for each element; plus a `build` of the
///         elements kept
/// \same   on any number of threads
template <std::ranges::random_access_range Range, class MakeBox, std::floating_point T,
          std::size_t D>
requires box_maker<MakeBox, std::ranges::range_reference_t<const Range>>
[[nodiscard]] tree<D> build_within(const Range& range, const MakeBox& make_aabb,
                                   const aabb<T, D>& within) {
    for (std::size_t k = 0; k < D; ++k)
        if (within.min[k] != within.min[k] || within.max[k] != within.max[k])
            throw std::invalid_argument(
                "treeform::build_within: the box has a coordinate that is NaN");
    detail::refuse_too_many<D>("treeform::build_within", range);
    const auto kept =
        detail::find_within("treeform::build_within", range, make_aabb, detail::in_double(within));
    return detail::tree_over<D>(kept.ids, range, make_aabb);
}

/// Two trees for a search of pairs, as std::pair(tree of a, tree of b). The tree of `b` has the
/// elements whose boxes meet the box around all of `a`; the tree of `a` has those that meet the box
/// around these elements of `b`. A search finds the same pairs as with trees over all elements.
/// Both trees are empty if the boxes around `a` and `b` are disjoint.
///
/// \throws std::invalid_argument as `build_within`
/// \cost   two linear passes over `a` and one over `b`, plus the builds over the elements kept
/// \same   on any number of threads
template <std::ranges::random_access_range A, class MakeBoxA, std::ranges::random_access_range B,
          class MakeBoxB>
requires box_maker<MakeBoxA, std::ranges::range_reference_t<const A>> &&
    box_maker<MakeBoxB, std::ranges::range_reference_t<const B>>
[[nodiscard]] auto build_overlap(const A& a, const MakeBoxA& make_aabb_a, const B& b,
                                 const MakeBoxB& make_aabb_b) {
    constexpr std::size_t D = detail::box_made<A, MakeBoxA>::dimensions;
    constexpr const char* name = "treeform::build_overlap";
    detail::refuse_too_many<D>(name, a);
    detail::refuse_too_many<D>(name, b);
    const auto kept_of_b =
        detail::find_within(name, b, make_aabb_b, detail::box_around<D>(name, a, make_aabb_a));
    const auto kept_of_a = kept_of_b.ids.empty()
                               ? detail::elements_within<D>{}
                               : detail::find_within(name, a, make_aabb_a, kept_of_b.box);
    return std::pair(detail::tree_over<D>(kept_of_a.ids, a, make_aabb_a),
                     detail::tree_over<D>(kept_of_b.ids, b, make_aabb_b));
}

}  // namespace treeform
