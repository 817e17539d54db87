#pragma once
/// \file
/// Numbers of faces listed by point, in parallel.

#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::base {

/// Faces point by point, ascending at each.
template <class Index>
struct faces_by_point {
    buffer<Index> end;            ///< [points] where the faces of each end in `faces`
    buffer<std::uint32_t> faces;  ///< point by point

    [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t point) const {
        const std::size_t begin = point == 0 ? 0 : static_cast<std::size_t>(end[point - 1]);
        return {faces.data() + begin, static_cast<std::size_t>(end[point]) - begin};
    }
};

/// Lists every i < `faces` at the points that `for_corners(i, visit)` hands to `visit`. Cut into at
/// most four slices of faces, since each has a count of its own at every point, and into fewer where
/// there are few faces for all these counts.
///
/// \pre  `Index` holds the number of entries
/// \same on any number of threads
template <class Index, class ForCorners>
[[nodiscard]] faces_by_point<Index> fill_stars(std::size_t points, std::size_t faces,
                                               const ForCorners& for_corners) {
    constexpr std::size_t least_slice = std::size_t{1} << 14, most_slices = 4;
    const std::size_t slice =
        std::max({least_slice, chunk_count(faces, most_slices), points / most_slices});
    // Counts of each slice, then where it puts its next face at each point.
    std::vector<buffer<Index>> next(std::max<std::size_t>(chunk_count(faces, slice), 1));
    for_chunks(next.size(), 1, [&](std::size_t c, std::size_t, std::size_t) {
        next[c].resize(points);
        std::fill_n(next[c].data(), points, Index{0});
        const std::size_t end = std::min((c + 1) * slice, faces);
        for (std::size_t i = c * slice; i < end; ++i)
            for_corners(i, [&](std::uint32_t p) { ++next[c][p]; });
    });
    faces_by_point<Index> result;
    Index total = 0;
    for (std::size_t p = 0; p < points; ++p)
        for (buffer<Index>& of_slice : next) total += std::exchange(of_slice[p], total);
    result.faces.resize(static_cast<std::size_t>(total));
    for_chunks(faces, slice, [&](std::size_t begin, std::size_t end, std::size_t c) {
        for (std::size_t i = begin; i < end; ++i)
            for_corners(i, [&](std::uint32_t p) {
                result.faces[static_cast<std::size_t>(next[c][p]++)] =
                    static_cast<std::uint32_t>(i);
            });
    });
    result.end = std::move(next.back());
    return result;
}

}  // namespace treeform::detail::base
