#include <libmesh/arrange/edge_stars.hpp>
#include <libmesh/base/stars.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace treeform::detail::arrange {
namespace {

constexpr std::size_t least_slice = std::size_t{1} << 14;
constexpr std::size_t most_slices = 4;  // each has a count of its own at every point

/// Calls `visit` for the two lower corners of each face.
template <class Visit>
void for_lower_corners(std::span<const face> faces, std::size_t begin, std::size_t end,
                       const Visit& visit) {
    for (std::size_t i = begin; i < end; ++i) {
        const auto& [a, b, c] = faces[i];
        if (!base::has_three_corners(faces[i])) continue;
        const std::uint32_t low = std::min(std::min(a, b), c);
        const std::uint32_t high = std::max(std::max(a, b), c);
        visit(i, low);
        visit(i, a ^ b ^ c ^ low ^ high);
    }
}

}  // namespace

edge_stars::edge_stars(std::size_t point_count, std::span<const face> faces) {
    const std::size_t points = base::nameable_points(point_count);
    const std::size_t slice = std::max(least_slice, (faces.size() + most_slices - 1) / most_slices);
    // Counts of each slice, then where it puts its next face at each point.
    std::vector<buffer<std::uint32_t>> next(
        std::max<std::size_t>(chunk_count(faces.size(), slice), 1));
    for_chunks(next.size(), 1, [&](std::size_t c, std::size_t, std::size_t) {
        next[c].resize(points);
        std::fill_n(next[c].data(), points, 0U);
        for_lower_corners(faces, std::min(c * slice, faces.size()),
                          std::min((c + 1) * slice, faces.size()),
                          [&](std::size_t, std::uint32_t p) { ++next[c][p]; });
    });
    std::uint32_t total = 0;
    for (std::size_t p = 0; p < points; ++p)
        for (buffer<std::uint32_t>& of_slice : next) total += std::exchange(of_slice[p], total);
    faces_.resize(total);
    for_chunks(faces.size(), slice, [&](std::size_t begin, std::size_t end, std::size_t c) {
        for_lower_corners(faces, begin, end, [&](std::size_t i, std::uint32_t p) {
            faces_[next[c][p]++] = static_cast<std::uint32_t>(i);
        });
    });
    end_ = std::move(next.back());
}

}  // namespace treeform::detail::arrange
