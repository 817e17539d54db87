#include <libmesh/base/union_find.hpp>
#include <libmesh/repair/copies.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace treeform::detail::repair {
namespace {

constexpr int most_looked_at = 8;  // copies of a face at its edge, lest many take quadratic time

using numbered_face = std::pair<face, std::uint32_t>;

/// By their corners, each with these ascending.
std::vector<numbered_face> sorted_by_corners(std::span<const face> faces) {
    std::vector<numbered_face> sorted;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        sorted.push_back({faces[f], f});
        std::ranges::sort(sorted.back().first);
    }
    std::ranges::sort(sorted);
    return sorted;
}

/// Joins each face to one beside it, not a copy, that runs the same way round.
void join_sheets(std::span<const face> faces, const std::vector<std::uint32_t>& first_copy,
                 const directed_edges& edges, base::union_find& sheets) {
    for (std::uint32_t f = 0; f < faces.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t u = faces[f][i], v = faces[f][(i + 1) % 3];
            std::uint32_t g = edges.face_along(v, u);
            for (int looked_at = 0; g != directed_edges::none && looked_at < most_looked_at &&
                                    first_copy[g] == first_copy[f];
                 ++looked_at)
                g = edges.face_along(v, u, g + 1);
            if (g != directed_edges::none && first_copy[g] != first_copy[f]) sheets.join(f, g);
        }
}

}  // namespace

std::vector<std::uint8_t> copies_to_delete(std::span<const face> faces,
                                           std::span<const std::uint32_t> part_of,
                                           const directed_edges& edges) {
    std::vector<std::uint8_t> deleted(faces.size(), 0);
    const std::vector<numbered_face> sorted = sorted_by_corners(faces);
    std::vector<std::uint32_t> first_copy(faces.size());
    std::vector<std::uint8_t> has_single(faces.size(), 0);  // by part
    const auto for_copies = [&](const auto& visit) {
        for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
            while (end < sorted.size() && sorted[end].first == sorted[begin].first) ++end;
            visit(std::span(sorted).subspan(begin, end - begin));
        }
    };
    for_copies([&](std::span<const numbered_face> copies) {
        for (const auto& [corners, f] : copies) first_copy[f] = copies.front().second;
        if (copies.size() == 1) has_single[part_of[copies.front().second]] = 1;
    });
    const auto may_go = [&](std::uint32_t f) { return has_single[part_of[f]] == 0; };
    if (std::ranges::none_of(part_of, may_go)) return deleted;
    base::union_find sheets(faces.size());
    join_sheets(faces, first_copy, edges, sheets);
    for_copies([&](std::span<const numbered_face> copies) {
        if (!may_go(copies.front().second)) return;
        std::uint32_t kept = copies.front().second;
        for (const auto& [corners, f] : copies) {
            deleted[f] = 1;
            if (sheets.root(f) < sheets.root(kept)) kept = f;
        }
        deleted[kept] = 0;
    });
    return deleted;
}

}  // namespace treeform::detail::repair
