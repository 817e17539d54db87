#include <libmesh/base/compact.hpp>
#include <libmesh/base/fill_stars.hpp>
#include <libmesh/base/first_bad.hpp>
#include <libmesh/base/flattened.hpp>
#include <libmesh/base/resize_all.hpp>
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

/// The corners of `f` after and before `point`, without a branch: which corner it is nobody can
/// predict.
std::array<std::uint32_t, 2> link_of(const face& f, std::uint32_t point) {
    constexpr std::array<std::uint8_t, 5> corner{0, 1, 2, 0, 1};
    const auto i =
        static_cast<std::size_t>(f[1] == point) + 2 * static_cast<std::size_t>(f[2] == point);
    return {f[corner[i + 1]], f[corner[i + 2]]};
}

/// As `is_one_fan`, of a few faces: all are compared with all, which is faster than to stop early.
constexpr std::size_t few = 8;
bool are_few_one_fan(std::span<const face> faces, std::span<const std::uint32_t> around,
                     std::uint32_t point) {
    constexpr std::uint32_t one = 16;  // counts, beside the number of a face
    static_assert(few <= one);
    std::array<std::uint32_t, few> after, before, following;
    after.fill(point);  // which no other corner is
    for (std::size_t i = 0; i < around.size(); ++i) {
        const auto [next, last] = link_of(faces[around[i]], point);
        after[i] = next;
        before[i] = last;
    }
    bool once = true;
    for (std::size_t i = 0; i < around.size(); ++i) {
        std::uint32_t sum = 0;
        for (std::uint32_t j = 0; j < few; ++j) sum += after[j] == before[i] ? one + j : 0;
        once &= sum / one == 1;
        following[i] = sum % one;
    }
    if (!once) return false;
    std::size_t steps = 0;
    std::uint32_t at = 0;
    do at = following[at];
    while (++steps < around.size() && at != 0);
    return at == 0 && steps == around.size();
}

/// Whether the faces at a point are one closed fan: from one to the next across the edge that it
/// has in common with it alone, and so around all of them.
bool is_one_fan(std::span<const face> faces, std::span<const std::uint32_t> around,
                std::uint32_t point, std::vector<std::array<std::uint32_t, 2>>& links) {
    if (around.empty()) return true;
    if (around.size() <= few) return are_few_one_fan(faces, around, point);
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
    return links.back()[1] == links.front()[0];
}

constexpr std::size_t star_grain = std::size_t{1} << 10;
constexpr std::size_t many = 64;  ///< faces at a point: they are not looked at
constexpr std::size_t ahead = 8;  ///< stars whose memory is under way

/// Whether all points are in one fan each: `point_of(i)` with the faces `star_of(i)`.
template <class StarOf, class PointOf>
bool are_all_one_fan(std::span<const face> faces, std::size_t count, const StarOf& star_of,
                     const PointOf& point_of) {
    std::atomic<bool> manifold{true};
    for_chunks(count, star_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        std::vector<std::array<std::uint32_t, 2>> links;
        for (std::size_t i = begin; i < end && manifold.load(std::memory_order_relaxed); ++i) {
            if (i + ahead < end)
                for (const std::uint32_t f : star_of(i + ahead)) __builtin_prefetch(&faces[f]);
            if (star_of(i).size() > many || !is_one_fan(faces, star_of(i), point_of(i), links))
                manifold = false;
        }
    });
    return manifold;
}

}  // namespace

std::vector<std::uint32_t> points_without_fan(mesh_view mesh) {
    const base::stars stars(mesh.points.size(), mesh.faces);
    std::vector<std::vector<std::uint32_t>> found(chunk_count(stars.size(), star_grain));
    for_chunks(stars.size(), star_grain,
               [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                   std::vector<std::array<std::uint32_t, 2>> links;
                   for (std::size_t v = begin; v < end; ++v) {
                       if (v + ahead < end)
                           for (const std::uint32_t f : stars[v + ahead])
                               __builtin_prefetch(&mesh.faces[f]);
                       const auto p = static_cast<std::uint32_t>(v);
                       if (stars[v].size() > many || !is_one_fan(mesh.faces, stars[v], p, links))
                           found[chunk].push_back(p);
                   }
               });
    return base::flattened(std::move(found));
}

bool is_manifold(mesh_view mesh) {
    return std::all_of(mesh.faces.begin(), mesh.faces.end(), base::has_three_corners) &&
           points_without_fan(mesh).empty();
}

bool is_manifold_at(std::span<const std::uint32_t> points, mesh_view mesh) {
    constexpr std::uint32_t none = 0xFFFFFFFF;
    buffer<std::uint32_t> number(mesh.points.size());
    for_chunks(number.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        std::fill(number.data() + begin, number.data() + end, none);
    });
    for_chunks(points.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
            std::atomic_ref(number[points[i]]).store(0, std::memory_order_relaxed);
    });
    std::vector<std::uint32_t> asked;
    base::compact(
        number.size(), [&](std::size_t p) { return number[p] != none; },
        [&](std::size_t count) { asked.resize(count); },
        [&](std::size_t p, std::size_t place) {
            number[p] = static_cast<std::uint32_t>(place);
            asked[place] = static_cast<std::uint32_t>(p);
        });
    const auto is_there = [&](std::size_t f) {
        const auto& [a, b, c] = mesh.faces[f];
        return number[a] != none || number[b] != none || number[c] != none;
    };
    std::vector<face> there;
    base::compact(
        mesh.faces.size(), is_there, [&](std::size_t count) { base::resize_all(count, there); },
        [&](std::size_t f, std::size_t place) { there[place] = mesh.faces[f]; });
    const auto is_bad = [&](std::size_t f) { return !base::has_three_corners(there[f]); };
    if (base::first_bad(there.size(), is_bad) != there.size()) return false;
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
