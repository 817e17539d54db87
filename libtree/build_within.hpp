#pragma once
/// \file
/// Trees over what can matter only: the primitives that reach into a box.

#include <libtree/aabb.hpp>
#include <libtree/build.hpp>
#include <libtree/detail/frame.hpp>
#include <libtree/detail/search_chunks.hpp>
#include <libtree/parallel.hpp>
#include <libtree/tree.hpp>

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

namespace tf {

/// A tree over some of the elements of a range.
template <std::size_t D>
struct partial_tree {
    tree<D> boxes;           ///< its `ids()` are places in the whole range, of those within only
    std::size_t considered;  ///< elements of the range
    [[nodiscard]] std::size_t skipped() const { return considered - boxes.size(); }
};

namespace detail {

inline constexpr std::size_t elements_per_chunk = std::size_t{1} << 13;

template <std::ranges::random_access_range Range>
[[nodiscard]] decltype(auto) at_place(const Range& range, std::size_t i) {
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

[[noreturn]] inline void refuse_element(const char* function, std::size_t element) {
    throw std::invalid_argument(std::string(function) + ": the box of element " +
                                std::to_string(element) + " is empty or not finite");
}

}  // namespace detail

/// The smallest box around the boxes that `make_aabb` gives for the elements of `range`; empty when
/// there are none.
///
/// \throws std::invalid_argument naming the element whose box is not finite or is empty
/// \cost   O(N), parallel; `make_aabb` is called once an element
/// \same   on any number of threads
template <std::ranges::random_access_range Range, class MakeBox>
requires box_maker<MakeBox, std::ranges::range_reference_t<const Range>>
[[nodiscard]] auto box_of_all(const Range& range, const MakeBox& make_aabb) {
    using box = detail::box_made<Range, MakeBox>;
    const auto size = static_cast<std::size_t>(std::ranges::size(range));
    std::vector<box> parts(chunk_count(size, detail::elements_per_chunk));
    std::atomic<std::size_t> bad{size};
    for_chunks(size, detail::elements_per_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                   box mine;
                   for (std::size_t i = begin; i < end; ++i) {
                       const box one = make_aabb(detail::at_place(range, i));
                       if (!detail::is_finite(one)) return detail::lower(bad, i);
                       mine.include(one);
                   }
                   parts[chunk] = mine;
               });
    if (bad.load() != size) detail::refuse_element("tf::box_of_all", bad.load());
    box all;
    for (const box& part : parts) all.include(part);
    return all;
}

/// The tree over the elements of `range` whose boxes meet `within`, touching included, and how many
/// were left out. Searches of it by anything within that box find what they find in a whole tree.
///
/// An empty box keeps nothing, an infinite one everything.
///
/// \throws std::invalid_argument as `build`, also for elements that are left out, or when `within`
///         has a coordinate that is NaN
/// \cost   O(N) for all, parallel, one call of `make_aabb` each; a build of those kept
/// \same   on any number of threads
template <std::ranges::random_access_range Range, class MakeBox, std::floating_point T,
          std::size_t D>
requires box_maker<MakeBox, std::ranges::range_reference_t<const Range>>
[[nodiscard]] partial_tree<D> build_within(const Range& range, const MakeBox& make_aabb,
                                           const aabb<T, D>& within) {
    for (std::size_t k = 0; k < D; ++k)
        if (within.min[k] != within.min[k] || within.max[k] != within.max[k])
            throw std::invalid_argument("tf::build_within: the box has a coordinate that is NaN");
    const aabb<double, D> wanted = detail::in_double(within);
    const auto size = static_cast<std::size_t>(std::ranges::size(range));
    if (size > tree<D>::max_size)
        throw std::invalid_argument("tf::build_within: " + std::to_string(size) +
                                    " elements are too many");
    using ids = std::vector<std::uint32_t>;
    std::vector<ids> parts(chunk_count(size, detail::elements_per_chunk));
    std::atomic<std::size_t> bad{size};
    for_chunks(size, detail::elements_per_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                   ids mine;
                   for (std::size_t i = begin; i < end; ++i) {
                       const auto box = make_aabb(detail::at_place(range, i));
                       if (!detail::is_finite(box)) return detail::lower(bad, i);
                       if (overlaps(detail::in_double(box), wanted))
                           mine.push_back(static_cast<std::uint32_t>(i));
                   }
                   parts[chunk] = std::move(mine);
               });
    if (bad.load() != size) detail::refuse_element("tf::build_within", bad.load());

    const ids kept = detail::joined(parts);
    partial_tree<D> result{
        build(kept, [&](std::uint32_t id) { return make_aabb(detail::at_place(range, id)); }),
        size};
    std::uint32_t* const places = result.boxes.ids_data();
    for_chunks(kept.size(), detail::elements_per_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t i = begin; i < end; ++i) places[i] = kept[places[i]];
               });
    return result;
}

/// Two trees for a search of pairs: those elements of `a` and of `b` whose boxes meet the box that
/// the box of all of `a` and the box of all of `b` have in common. The pairs found are those that
/// whole trees give; both are empty when the boxes of all are disjoint.
///
/// \throws std::invalid_argument as `build_within`
/// \cost   two linear passes over both, and the builds of those kept
/// \same   on any number of threads
template <std::ranges::random_access_range A, class MakeBoxA, std::ranges::random_access_range B,
          class MakeBoxB>
requires box_maker<MakeBoxA, std::ranges::range_reference_t<const A>> &&
    box_maker<MakeBoxB, std::ranges::range_reference_t<const B>>
[[nodiscard]] auto build_overlap(const A& a, const MakeBoxA& make_aabb_a, const B& b,
                                 const MakeBoxB& make_aabb_b) {
    const auto common = common_box(detail::in_double(box_of_all(a, make_aabb_a)),
                                   detail::in_double(box_of_all(b, make_aabb_b)));
    return std::pair(build_within(a, make_aabb_a, common), build_within(b, make_aabb_b, common));
}

}  // namespace tf
