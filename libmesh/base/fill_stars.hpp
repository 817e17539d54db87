#pragma once
/// \file
/// Lists faces by point, in parallel.

#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::base {

/// Lists of face numbers, or other values, for each point, ascending.
template <class Index, class Value = std::uint32_t>
struct faces_by_point {
    buffer<Index> end;    ///< [points] end of the list of each point in `faces`
    buffer<Value> faces;  ///< the lists, point by point

    [[nodiscard]] std::span<const Value> operator[](std::size_t point) const {
        const std::size_t begin = point == 0 ? 0 : static_cast<std::size_t>(end[point - 1]);
        return {faces.data() + begin, static_cast<std::size_t>(end[point]) - begin};
    }
};

/// Collects the values for which `for_values(i, visit)` calls `visit(point, value)`, for all i <
/// `count`, into a list for each point, in the order of i. A bucket sort: by ranges of points
/// first, then by point. Calls `finish` with each list, for example to sort it.
///
/// \pre  `Index` can represent the number of entries
/// \cost O(points + entries) time; temporary memory of a value and 4 bytes for each entry
/// \same on any number of threads
template <class Index, class Value, class ForValues, class Finish>
[[nodiscard]] faces_by_point<Index, Value> fill_lists(std::size_t points, std::size_t count,
                                                      const ForValues& for_values,
                                                      const Finish& finish) {
    constexpr std::size_t least_slice = std::size_t{1} << 11, most_slices = 64;
    constexpr int least_bits = 10, most_bucket_bits = 9;
    const int shift =
        std::max(static_cast<int>(std::bit_width(points)) - most_bucket_bits, least_bits);
    const std::size_t buckets = (points >> shift) + 1;
    const std::size_t slice = std::max(least_slice, chunk_count(count, most_slices));
    const std::size_t slices = chunk_count(count, slice);
    std::vector<std::size_t> next(slices * buckets, 0);  // of each slice in each bucket
    for_chunks(count, slice, [&](std::size_t begin, std::size_t end, std::size_t c) {
        std::size_t* const size = next.data() + c * buckets;
        for (std::size_t i = begin; i < end; ++i)
            for_values(i, [&](std::uint32_t p, const Value&) { ++size[p >> shift]; });
    });
    std::vector<std::size_t> first(buckets + 1, 0);
    for (std::size_t b = 0; b < buckets; ++b) {
        first[b + 1] = first[b];
        for (std::size_t c = 0; c < slices; ++c)
            first[b + 1] += std::exchange(next[c * buckets + b], first[b + 1]);
    }
    struct entry {
        Value value;
        std::uint32_t point;
    };
    buffer<entry> entries(first[buckets]);
    for_chunks(count, slice, [&](std::size_t begin, std::size_t end, std::size_t c) {
        std::size_t* const at = next.data() + c * buckets;
        for (std::size_t i = begin; i < end; ++i)
            for_values(i, [&](std::uint32_t p, const Value& value) {
                entries[at[p >> shift]++] = {value, p};
            });
    });
    faces_by_point<Index, Value> result;
    result.end.resize(points);
    result.faces.resize(entries.size());
    for_chunks(buckets, 1, [&](std::size_t b, std::size_t, std::size_t) {
        const std::size_t begin = b << shift, end = std::min((b + 1) << shift, points);
        const std::span<const entry> mine(entries.data() + first[b], entries.data() + first[b + 1]);
        Index* const place = result.end.data();
        for (std::size_t p = begin; p < end; ++p) place[p] = 0;
        for (const entry& e : mine) ++place[e.point];
        Index total = static_cast<Index>(first[b]);
        for (std::size_t p = begin; p < end; ++p) total += std::exchange(place[p], total);
        for (const entry& e : mine)
            result.faces[static_cast<std::size_t>(place[e.point]++)] = e.value;
        std::size_t from = first[b];
        for (std::size_t p = begin; p < end; ++p) {
            const auto to = static_cast<std::size_t>(place[p]);
            finish(std::span<Value>(result.faces.data() + from, result.faces.data() + to));
            from = to;
        }
    });
    return result;
}

/// The same for faces: face i is listed at the points with which `for_corners(i, visit)` calls
/// `visit`.
template <class Index, class ForCorners>
[[nodiscard]] faces_by_point<Index> fill_stars(std::size_t points, std::size_t faces,
                                               const ForCorners& for_corners) {
    return fill_lists<Index, std::uint32_t>(
        points, faces,
        [&](std::size_t i, const auto& visit) {
            for_corners(i, [&](std::uint32_t p) { visit(p, static_cast<std::uint32_t>(i)); });
        },
        [](std::span<std::uint32_t>) {});
}

}  // namespace treeform::detail::base
