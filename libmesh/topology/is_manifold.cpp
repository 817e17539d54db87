#include <libmesh/base/compact.hpp>
#include <libmesh/base/fill_stars.hpp>
#include <libmesh/base/stars.hpp>
#include <libmesh/topology/is_manifold.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::topology {
namespace {

/// The corners of `f` after and before `point`.
std::array<std::uint32_t, 2> link_of(const face& f, std::uint32_t point) {
    const std::size_t i = f[0] == point ? 0 : f[1] == point ? 1 : 2;
    return {f[(i + 1) % 3], f[(i + 2) % 3]};
}

/// Whether the faces at a point are one closed fan: from one to the next across the edge that it
/// has in common with it alone, and so around all of them.
bool is_one_fan(std::span<const face> faces, std::span<const std::uint32_t> around,
                std::uint32_t point, std::vector<std::array<std::uint32_t, 2>>& links) {
    links.clear();
    for (const std::uint32_t f : around) links.push_back(link_of(faces[f], point));
    for (std::size_t i = 0; i + 1 < links.size(); ++i) {
        if (links[i][1] == links.front()[0]) return false;
        std::size_t following = 0;
        for (std::size_t j = i + 1; j < links.size(); ++j)
            if (links[j][0] == links[i][1]) following = following == 0 ? j : links.size();
        if (following == 0 || following == links.size()) return false;
        std::swap(links[i + 1], links[following]);
    }
    return links.empty() || links.back()[1] == links.front()[0];
}

/// Whether all points are in one fan each: `point_of(i)` with the faces `star_of(i)`.
template <class StarOf, class PointOf>
bool are_all_one_fan(std::span<const face> faces, std::size_t count, const StarOf& star_of,
                     const PointOf& point_of) {
    constexpr std::size_t many = 64;
    std::atomic<bool> manifold{true};
    for_chunks(count, light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        std::vector<std::array<std::uint32_t, 2>> links;
        for (std::size_t i = begin; i < end && manifold.load(std::memory_order_relaxed); ++i)
            if (star_of(i).size() > many || !is_one_fan(faces, star_of(i), point_of(i), links))
                manifold = false;
    });
    return manifold;
}

}  // namespace

bool is_manifold(mesh_view mesh) {
    const base::stars stars(mesh.points.size(), mesh.faces);
    return stars.face_count() == mesh.faces.size() &&
           are_all_one_fan(
               mesh.faces, stars.size(), [&](std::size_t v) { return stars[v]; },
               [](std::size_t v) { return static_cast<std::uint32_t>(v); });
}

bool is_manifold_at(std::span<const std::uint32_t> points, mesh_view mesh) {
    constexpr std::uint32_t none = 0xFFFFFFFF;
    buffer<std::uint32_t> number(mesh.points.size());
    for_chunks(number.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        std::fill(number.data() + begin, number.data() + end, none);
    });
    std::vector<std::uint32_t> asked;
    for (const std::uint32_t p : points) {
        if (number[p] != none) continue;
        number[p] = static_cast<std::uint32_t>(asked.size());
        asked.push_back(p);
    }
    const auto is_there = [&](std::size_t f) {
        const auto& [a, b, c] = mesh.faces[f];
        return number[a] != none || number[b] != none || number[c] != none;
    };
    std::vector<face> there;
    base::compact(
        mesh.faces.size(), is_there, [&](std::size_t count) { there.resize(count); },
        [&](std::size_t f, std::size_t place) { there[place] = mesh.faces[f]; });
    if (!std::all_of(there.begin(), there.end(), base::has_three_corners)) return false;
    const auto stars = base::fill_stars<std::size_t>(asked.size(), there.size(),
                                                     [&](std::size_t f, const auto& visit) {
                                                         for (const std::uint32_t corner : there[f])
                                                             if (number[corner] != none)
                                                                 visit(number[corner]);
                                                     });
    return are_all_one_fan(
        there, asked.size(), [&](std::size_t i) { return stars[i]; },
        [&](std::size_t i) { return asked[i]; });
}

}  // namespace treeform::detail::topology
