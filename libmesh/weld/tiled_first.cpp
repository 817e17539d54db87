#include <libmesh/base/point_math.hpp>
#include <libmesh/weld/cube_index.hpp>
#include <libmesh/weld/group_points.hpp>
#include <libmesh/weld/lattice.hpp>
#include <libmesh/weld/near_pairs.hpp>
#include <libmesh/weld/reach.hpp>
#include <libmesh/weld/tile_cuts.hpp>
#include <libmesh/weld/tile_weld.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

namespace treeform::detail::weld {
namespace {

/// Kept points that fit a cache whatever the order in which points come.
constexpr std::size_t few_kept = std::size_t{1} << 16;

/// Finite points by tile: those of its part of space and of its halo, ascending.
struct tiled_points {
    static constexpr std::uint32_t shared = std::uint32_t{1} << 31;
    static constexpr std::uint32_t nowhere = ~std::uint32_t{0};

    std::vector<std::size_t> begin;  ///< [tiles + 1] in `ids`
    buffer<std::uint32_t> ids;
    buffer<std::uint32_t> tile_of;  ///< [V] the own tile, and `shared` where others know it, too

    [[nodiscard]] tile_point at(std::size_t tile, std::size_t place, points_view points) const {
        const std::uint32_t id = ids[place];
        const std::uint32_t own = tile_of[id];
        const tile_role role = (own & ~shared) != tile ? tile_role::halo
                               : (own & shared) != 0   ? tile_role::shared
                                                       : tile_role::own;
        return tile_point::make(id, role, points[id]);
    }
};

/// None where halos would hold more points than half of all.
std::optional<tiled_points> distribute(points_view points, const tile_cuts& cuts) {
    struct in_halo {
        std::uint32_t id;
        std::uint32_t tile;
    };
    const std::size_t tiles = cuts.size();
    const std::size_t chunk = std::max(std::size_t{1} << 17, points.size() / 256);
    const std::size_t chunks = chunk_count(points.size(), chunk);
    std::vector<std::vector<in_halo>> halos(chunks);
    std::vector<std::vector<std::size_t>> place(chunks, std::vector<std::size_t>(tiles, 0));
    tiled_points result;
    result.tile_of = buffer<std::uint32_t>(points.size());
    for_chunks(points.size(), chunk, [&](std::size_t begin, std::size_t end, std::size_t c) {
        std::vector<std::uint32_t> others;
        for (std::size_t i = begin; i < end && halos[c].size() <= chunk / 2; ++i) {
            result.tile_of[i] = tiled_points::nowhere;
            if (!base::is_finite(points[i])) continue;
            const std::uint32_t own = cuts.find(points[i], others);
            result.tile_of[i] = own | (others.empty() ? 0 : tiled_points::shared);
            ++place[c][own];
            for (const std::uint32_t tile : others) {
                ++place[c][tile];
                halos[c].push_back({static_cast<std::uint32_t>(i), tile});
            }
        }
    });
    if (std::any_of(halos.begin(), halos.end(),
                    [&](const auto& some) { return some.size() > chunk / 2; }))
        return std::nullopt;
    std::size_t next = 0;
    for (std::size_t t = 0; t < tiles; ++t) {
        result.begin.push_back(next);
        for (std::size_t c = 0; c < chunks; ++c) next += std::exchange(place[c][t], next);
    }
    result.begin.push_back(next);
    result.ids = buffer<std::uint32_t>(next);
    for_chunks(points.size(), chunk, [&](std::size_t begin, std::size_t end, std::size_t c) {
        auto halo = halos[c].begin();
        for (std::size_t i = begin; i < end; ++i) {
            if (result.tile_of[i] == tiled_points::nowhere) continue;
            const auto id = static_cast<std::uint32_t>(i);
            result.ids[place[c][result.tile_of[i] & ~tiled_points::shared]++] = id;
            for (; halo != halos[c].end() && halo->id == id; ++halo)
                result.ids[place[c][halo->tile]++] = id;
        }
    });
    return result;
}

/// What came of a tile.
struct welded_tile {
    std::vector<border_point> border;  ///< left to the border pass
    std::size_t dropped = 0;
    bool given_up = false;  ///< the border had more than its share
};

/// Writes the leaders that a tile knows.
welded_tile weld_tile(points_view points, const tiled_points& tiled, std::size_t tile,
                      double tolerance, std::size_t largest_border,
                      std::vector<std::uint32_t>& leader_of) {
    constexpr std::size_t block = 1024;
    constexpr bool chain = false;
    tile_weld weld(chain, tolerance);
    tile_result found;
    welded_tile result;
    std::vector<tile_point> some;
    const std::size_t end = tiled.begin[tile + 1];
    weld.reserve((end - tiled.begin[tile]) / 4);
    for (std::size_t place = tiled.begin[tile]; place < end && !result.given_up;) {
        some.clear();
        for (; place < end && some.size() < block; ++place)
            some.push_back(tiled.at(tile, place, points));
        weld.add(some, found);
        for (const tile_drop& drop : found.dropped)
            leader_of[drop.id] = static_cast<std::uint32_t>(drop.leader);
        result.dropped += found.dropped.size();
        found.dropped.clear();
        result.given_up = found.border.size() > largest_border;
    }
    result.border = std::move(found.border);
    return result;
}

}  // namespace

std::vector<std::uint32_t> dense_leaders(points_view points, const weld_options& options) {
    constexpr std::size_t per_call = std::size_t{1} << 16;
    // Cubes twice the tolerance wide: it reaches two a side.
    const cube_axis axis(2.0 * options.tolerance);
    const double reach_in_cubes = 0.5;
    const reach within(options.tolerance);
    const auto label_of = [&](std::uint32_t i) {
        return options.label.empty() ? 0U : options.label[i];
    };
    std::vector<std::uint32_t> leader_of(points.size());
    hashed_ids kept;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        if (i % per_call == 0 && options.progress &&
            !options.progress(static_cast<double>(i) / static_cast<double>(points.size())))
            return {};
        leader_of[i] = i;
        const point3& p = points[i];
        if (!base::is_finite(p)) continue;
        std::array<cube_axis::range, 3> ranges;
        for (std::size_t k = 0; k < 3; ++k) ranges[k] = axis.around(p[k], reach_in_cubes);
        std::array<std::uint64_t, 27> hashes;
        std::size_t count = 0;
        for (std::int64_t x = ranges[0].first; x <= ranges[0].last; ++x)
            for (std::int64_t y = ranges[1].first; y <= ranges[1].last; ++y)
                for (std::int64_t z = ranges[2].first; z <= ranges[2].last; ++z) {
                    hashes[count] = cube_hash(x, y, z, label_of(i));
                    kept.prefetch(hashes[count++]);
                }
        nearest_kept best(p);
        const auto consider = [&](std::uint32_t other) {
            if (label_of(i) != label_of(other) || !within.holds(p, points[other])) return;
            if (!options.may_merge || options.may_merge(i, other))
                best.consider(other, points[other]);
        };
        for (std::size_t k = 0; k < count; ++k) kept.visit(hashes[k], consider);
        if (best.any())
            leader_of[i] = static_cast<std::uint32_t>(best.id());
        else
            kept.add(cube_hash(axis.index(p.x), axis.index(p.y), axis.index(p.z), label_of(i)), i);
    }
    return leader_of;
}

bool can_be_tiled(points_view points, const weld_options& options) {
    constexpr std::size_t least = std::size_t{1} << 18;
    constexpr double largest = 0x1p990;  // beyond, tiles have one cube (near_cells.hpp)
    return options.tolerance < largest && !options.chain && options.label.empty() &&
           !options.may_merge && points.size() >= least;
}

bool is_window_wide(points_view points, double tolerance) {
    const std::optional<lattice> steps = lattice::over(points, tolerance);
    return steps && estimated_window(points, *steps) >= wide_window;
}

std::vector<std::uint32_t> tiled_leaders(points_view points, const weld_options& options,
                                         const tiling& how) {
    constexpr std::size_t most_tiles = 4096;
    constexpr std::size_t sample_a_tile = 64;
    constexpr std::size_t tiles_a_call = 64;
    const std::size_t count = std::min(most_tiles, points.size() / how.points_a_tile + 1);
    std::vector<point3> sample;
    for (std::size_t i = 0; i < points.size(); i += points.size() / (count * sample_a_tile) + 1)
        if (base::is_finite(points[i])) sample.push_back(points[i]);
    const tile_cuts cuts(sample, options.tolerance, count);
    if (how.when == tiling::if_faster && cuts.size() < 3) return {};
    const std::optional<tiled_points> tiled = distribute(points, cuts);
    if (!tiled) return {};
    std::vector<std::uint32_t> leader_of(points.size());
    std::iota(leader_of.begin(), leader_of.end(), 0U);

    std::vector<welded_tile> tiles(cuts.size());
    const auto weld_tiles = [&](std::span<const std::size_t> some, std::size_t largest_border) {
        for_chunks(some.size(), 1, [&](std::size_t k, std::size_t, std::size_t) {
            tiles[some[k]] =
                weld_tile(points, *tiled, some[k], options.tolerance, largest_border, leader_of);
        });
    };
    std::vector<std::size_t> left(cuts.size());
    std::iota(left.begin(), left.end(), std::size_t{0});
    if (how.when == tiling::if_faster) {
        const std::array tried{cuts.size() / 3, cuts.size() * 2 / 3};
        weld_tiles(tried, how.points_a_tile / 4);
        std::size_t known = 0;
        std::size_t kept = 0;
        for (const std::size_t t : tried) {
            if (tiles[t].given_up) return {};
            known += tiled->begin[t + 1] - tiled->begin[t];
            kept += tiled->begin[t + 1] - tiled->begin[t] - tiles[t].dropped;
            std::erase(left, t);
        }
        if (kept * (points.size() / 1024) < known * (few_kept / 1024)) return {};
    }
    for (std::size_t first = 0; first < left.size(); first += tiles_a_call) {
        if (options.progress &&
            !options.progress(static_cast<double>(first) / static_cast<double>(left.size())))
            return {};
        weld_tiles(std::span(left).subspan(first, std::min(tiles_a_call, left.size() - first)),
                   points.size());
    }

    std::vector<border_point> border;
    for (welded_tile& tile : tiles) {
        border.insert(border.end(), tile.border.begin(), tile.border.end());
        tile = {};
    }
    std::sort(border.begin(), border.end(),
              [](const border_point& a, const border_point& b) { return a.tag < b.tag; });
    border_weld weld(options.tolerance);
    tile_result found;
    for (const border_point& point : border) weld.add(point, {}, false, found);
    for (const tile_drop& drop : found.dropped)
        leader_of[drop.id] = static_cast<std::uint32_t>(drop.leader);
    return leader_of;
}

}  // namespace treeform::detail::weld
