/// \file
/// How a cloud is cut into tiles, judged by samples of its points.

#include <libmesh/stream/tile_steps.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace treeform::detail::stream {
namespace {

std::string in_megabytes(std::uint64_t bytes) {
    return std::to_string((bytes + (1U << 20) - 1) >> 20) + "M";
}

}  // namespace

/// What some cuts come to.
struct tile_steps::cut_sizes {
    double points = 0.0;   ///< of all tiles, halos included
    double largest = 0.0;  ///< points in a tile
    double held = 0.0;     ///< places in a tile, which are about what it has to hold
    double border = 0.0;   ///< places in several tiles that are held at a time
};

struct tile_steps::planned {
    tile_cuts cuts;
    memory_needs needs{};
};

tile_steps::cut_sizes tile_steps::sizes_of(const tile_cuts& cuts) const {
    std::vector<std::uint32_t> halos;
    const bool chained = by_chain();  // equal points take room
    const auto count = [&](const point_survey::part& sample, double& largest, double& several) {
        std::vector<double> size(cuts.size(), 0.0);
        double sum = 0.0;
        for (std::size_t i = 0; i < sample.points.size(); ++i) {
            const double each =
                (chained && !sample.counts.empty() ? sample.counts[i] : 1) / sample.share;
            size[cuts.find(sample.points[i], halos)] += each;
            for (const std::uint32_t t : halos) size[t] += each;
            if (!halos.empty()) several += each;
            sum += each * static_cast<double>(1 + halos.size());
        }
        largest = *std::max_element(size.begin(), size.end());
        return sum;
    };
    cut_sizes sizes;
    double ignored = 0.0;
    sizes.points = count(survey_.sample, sizes.largest, ignored);
    static_cast<void>(count(places(), sizes.held, sizes.border));
    if (!chained) sizes.border = 0.0;  // in runs that fit
    return sizes;
}

const point_survey::part& tile_steps::places() const {
    return survey_.places ? *survey_.places : survey_.sample;
}

/// Crowds take room on the disk, but not where they are welded. With the rule first they are best
/// not cut; chains are welded crowd by crowd only where there is no other way.
void tile_steps::plan() {
    point_survey::part uncrowded = uncrowded_sample();
    const bool crowded = 4 * uncrowded.points.size() <= 3 * survey_.sample.points.size();
    if (!survey_.places) survey_.places = std::move(uncrowded);
    const std::uint64_t least =
        weld_stream_options::memory_to_stream(source_.header(), survey_.cloud.points);
    std::optional<planned> best;
    if (least <= task_.memory || task_.options.points_per_tile > 0) {
        if (crowded && !by_chain()) best = plan_by(true);
        if (!best) best = plan_by(false);
        if (!best && (!by_chain() || values() == 0)) best = plan_by(true);
    }
    if (!best) best = plan_for_least_memory();
    const std::uint64_t needed = std::max(best->needs.tiles, best->needs.borders);
    // Who comes back with the memory that was said has other samples. In percent, they say little.
    const bool is_enough =
        task_.options.relative || left_for_points(needed) / 8 * 7 <= task_.options.memory;
    if (least > task_.memory || !is_enough) fail_for_memory(std::max(least, needed));
    needs_ = {std::min(best->needs.tiles, task_.memory),
              std::min(best->needs.borders, task_.memory)};
    cuts_ = std::move(best->cuts);
}

tile_steps::memory_needs tile_steps::needs_of(const cut_sizes& sizes) const {
    const auto each = static_cast<double>(bytes_per_point());
    double held = sizes.held * each;
    if (by_chain())  // or cube by cube, which conditions rule out
        held = values() > 0 ? sizes.largest * each
                            : std::min(sizes.largest * each, sizes.held * bytes_of_cube);
    const auto memory = [](double bytes) {
        constexpr std::uint64_t program = std::uint64_t{16} << 20;
        return std::max(program,
                        memory_with(static_cast<std::uint64_t>(std::min(bytes / 0.7, 1e18))));
    };
    return {memory(held), memory(sizes.border * bytes_of_border)};
}

tile_steps::memory_needs tile_steps::needs_of_one_tile(std::uint64_t points) const {
    const auto all = static_cast<double>(points);
    return needs_of({.points = all, .largest = all, .held = all});
}

/// Small tiles stay in the caches while they are welded. Where halos are much of them, larger
/// ones; where they are most of all, the tolerance is large and little will be kept: one tile.
std::optional<tile_steps::planned> tile_steps::plan_by(bool by_places) const {
    const auto all = static_cast<double>(survey_.cloud.points);
    const std::vector<point3>& sample = by_places ? places().points : survey_.sample.points;
    const auto cuts_of = [&](double count) {
        return tile_cuts(sample, tolerance_,
                         static_cast<std::size_t>(std::ceil(std::max(count, 1.0))));
    };
    if (task_.options.points_per_tile > 0) {
        tile_cuts cuts = cuts_of(all / static_cast<double>(task_.options.points_per_tile));
        const memory_needs needs = needs_of(sizes_of(cuts));
        return planned{std::move(cuts), needs};
    }
    constexpr double small = 250000.0;
    constexpr double tiles = 1024.0;
    const auto points_in_memory = task_.options.memory / bytes_per_point();
    const double room = 0.6 * static_cast<double>(points_in_memory);
    struct way {
        double most;       ///< points in a tile, about
        double with_halo;  ///< points of all tiles, of all points
    };
    // Of several ranks, all have several, and so about the same.
    const double several =
        communicator_.is_alone() ? all : all / (8.0 * static_cast<double>(communicator_.size()));
    for (const way w : {way{std::min({0.25 * room, std::max(small, all / tiles), several}), 1.1},
                        way{std::min(0.25 * room, several), 1.5}, way{room, 4.0}}) {
        cut_sizes sizes;
        for (double count = all / w.most; sizes.points <= w.with_halo * all;
             count = 1.25 * count + 1.0) {
            tile_cuts cuts = cuts_of(count);
            sizes = sizes_of(cuts);
            const double held = by_places ? sizes.held : sizes.largest;
            const memory_needs needs = needs_of(sizes);
            if (sizes.points <= w.with_halo * all && held <= 1.25 * w.most &&
                std::max(needs.tiles, needs.borders) <= task_.memory)
                return planned{std::move(cuts), needs};
            if (count > static_cast<double>(sample.size())) break;  // equal points
        }
    }
    return std::nullopt;
}

/// By chain, it depends on what lies along the borders; with tiles of a given size, on their halos.
bool tile_steps::needs_survey() const {
    const weld_stream_options& o = task_.options;
    return o.points_per_tile > 0 || by_chain();
}

/// As many tiles as hold least at a time.
tile_steps::planned tile_steps::plan_for_least_memory() const {
    std::optional<planned> best;
    const auto needed = [](const memory_needs& n) { return std::max(n.tiles, n.borders); };
    const double points = static_cast<double>(places().points.size());
    for (double count = 1.0; count <= std::max(1.0, points / 64.0); count *= 2.0) {
        tile_cuts cuts(places().points, tolerance_, static_cast<std::size_t>(count));
        const memory_needs needs = needs_of(sizes_of(cuts));
        if (best && needed(needs) >= needed(best->needs)) continue;
        best = {std::move(cuts), needs};
    }
    return std::move(*best);
}

void tile_steps::check_before_survey() {
    const std::uint64_t points = source_.count();
    const std::uint64_t least = weld_stream_options::memory_to_stream(source_.header(), points);
    const std::string of_tiles = " for the tiles in " + folder_.path().string();
    if (!task_.options.shared && finds_tiles()) {
        const bool all_finished = survey_.cloud.unfinished.empty();
        const std::uint64_t needed =
            std::max({least, all_finished ? 0 : needs_.tiles, needs_of_rest()});
        if (needed > task_.memory) fail_for_memory(needed, of_tiles);
        return;
    }
    if (least <= task_.memory) return;
    if (!needs_survey()) fail_for_memory(least);
    if (task_.memory >= base_memory && !has_plan()) return;
    const std::uint64_t enough = std::max(least, needs_of_one_tile(points).tiles);
    fail_for_memory(enough, enough == least ? ""
                                            : " for any cloud, and at least " +
                                                  in_megabytes(least) + " is needed");
}

/// When tiles are finished: their borders, and a look at what is kept, which has tiles, too.
std::uint64_t tile_steps::needs_of_rest() const {
    return task_.options.keep == weld_keep::first ? needs_.borders
                                                  : std::max(needs_.borders, needs_.tiles);
}

void tile_steps::check_before_tile() const {
    if (needs_.tiles > task_.memory)
        fail_for_memory(needs_.tiles, " for the tiles in " + folder_.path().string());
}

void tile_steps::check_before_borders() const {
    const std::uint64_t needed =
        std::max(needs_of_rest(),
                 weld_stream_options::memory_to_stream(source_.header(), survey_.cloud.points));
    if (needed > task_.memory) fail_for_memory(needed);
}

void tile_steps::fail_for_memory(std::uint64_t needed, const std::string& more) const {
    throw io_error(io_error::kind::memory, folder_.path(),
                   "a memory limit of " + in_megabytes(task_.memory) + " is too little; " +
                       in_megabytes(needed) + " would be enough" + more,
                   needed);
}

/// Of the points of a cube whose diagonal is the tolerance, one.
point_survey::part tile_steps::uncrowded_sample() const {
    std::vector<std::pair<std::uint64_t, point3>> by_cube;
    by_cube.reserve(survey_.sample.points.size());
    for (const point3& p : survey_.sample.points) by_cube.emplace_back(cube_of(p, tolerance_), p);
    const auto before = [](const auto& a, const auto& b) { return a.first < b.first; };
    const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
    std::stable_sort(by_cube.begin(), by_cube.end(), before);
    by_cube.erase(std::unique(by_cube.begin(), by_cube.end(), same), by_cube.end());
    point_survey::part some{.share = survey_.sample.share};
    some.points.reserve(by_cube.size());
    for (const auto& [cube, p] : by_cube) some.points.push_back(p);
    return some;
}

}  // namespace treeform::detail::stream
