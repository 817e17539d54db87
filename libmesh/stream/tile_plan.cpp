/// \file
/// How a cloud is cut into tiles, judged by a sample of its points.

#include <libmesh/stream/tile_steps.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace treeform::detail::stream {

/// Crowds take room on the disk, but not where they are welded. With the rule first they are best
/// not cut; chains are welded crowd by crowd only where there is no other way.
tile_cuts tile_steps::plan() const {
    const std::vector<point3> some = uncrowded_sample();
    const bool crowded = 4 * some.size() <= 3 * survey_.sample.size();
    if (crowded && rule() == weld_rule::first)
        if (const auto cuts = plan_by(some)) return *cuts;
    if (const auto cuts = plan_by(survey_.sample)) return *cuts;
    if (const auto cuts = plan_by(some)) return *cuts;
    return {some, tolerance_, 1};
}

/// Small tiles stay in the caches while they are welded. Where halos are much of them, larger
/// ones; where they are most of all, the tolerance is large and little will be kept: one tile.
std::optional<tile_cuts> tile_steps::plan_by(const std::vector<point3>& sample) const {
    const auto all = static_cast<double>(survey_.cloud.points);
    const auto cuts_of = [&](double count) {
        return tile_cuts(sample, tolerance_,
                          static_cast<std::size_t>(std::ceil(std::max(count, 1.0))));
    };
    if (task_.options.points_per_tile > 0)
        return cuts_of(all / static_cast<double>(task_.options.points_per_tile));
    constexpr double small = 250000.0;
    constexpr double tiles = 1024.0;
    const auto points_in_memory = task_.options.memory / bytes_per_point();
    const double room = 0.6 * static_cast<double>(points_in_memory);
    struct way {
        double most;       ///< points in a tile, about
        double with_halo;  ///< points of all tiles, of all points
    };
    for (const way w : {way{std::min(0.25 * room, std::max(small, all / tiles)), 1.1},
                        way{0.25 * room, 1.5}, way{room, 4.0}}) {
        double sum = 0.0;
        for (double count = all / w.most; sum <= w.with_halo * all; count = 1.25 * count + 1.0) {
            const tile_cuts cuts = cuts_of(count);
            const std::vector<double> size = sizes_of(cuts, survey_.sample);
            const std::vector<double> held = sizes_of(cuts, sample);
            sum = std::accumulate(size.begin(), size.end(), 0.0);
            const double largest = *std::max_element(held.begin(), held.end());
            if (sum <= w.with_halo * all && largest <= 1.25 * w.most) return cuts;
            if (count > static_cast<double>(sample.size())) break;  // equal points
        }
    }
    return std::nullopt;
}

/// Of the points of a cube whose diagonal is the tolerance, one.
std::vector<point3> tile_steps::uncrowded_sample() const {
    std::vector<std::pair<std::array<double, 3>, point3>> by_cube;
    for (const point3& p : survey_.sample) {
        std::array<double, 3> cube{p.x, p.y, p.z};
        if (tolerance_ > 0.0)
            for (double& c : cube) c = std::floor(c / tolerance_ * 1.74);
        by_cube.emplace_back(cube, p);
    }
    const auto before = [](const auto& a, const auto& b) { return a.first < b.first; };
    const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
    std::stable_sort(by_cube.begin(), by_cube.end(), before);
    by_cube.erase(std::unique(by_cube.begin(), by_cube.end(), same), by_cube.end());
    std::vector<point3> some;
    some.reserve(by_cube.size());
    for (const auto& [cube, p] : by_cube) some.push_back(p);
    return some;
}

/// Points in each tile, halo included, judged by a sample.
std::vector<double> tile_steps::sizes_of(const tile_cuts& cuts,
                                         const std::vector<point3>& sample) const {
    std::vector<double> size(cuts.size(), 0.0);
    std::vector<std::uint32_t> halos;
    const double each = 1.0 / survey_.sample_share;
    for (const point3& p : sample) {
        size[cuts.find(p, halos)] += each;
        for (const std::uint32_t t : halos) size[t] += each;
    }
    return size;
}

}  // namespace treeform::detail::stream
