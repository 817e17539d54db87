#include <libmesh/weld/cube_index.hpp>
#include <libmesh/weld/group_points.hpp>
#include <libmesh/weld/reach.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/brute_weld.hpp>
#include <support/weld_families.hpp>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

namespace {

using tf::point3;
using numbers = std::vector<std::uint32_t>;

/// Chains found by the dense way, whatever the points, are those of all pairs.
void check_chains(const std::vector<point3>& points, double tolerance, const numbers& label = {},
                  const std::function<bool(std::uint32_t, std::uint32_t)>& may_merge = {}) {
    const auto linked = [&](std::uint32_t i, std::uint32_t j) {
        return (label.empty() || label[i] == label[j]) &&
               tf::test::brute_within(points[i], points[j], tolerance) &&
               (!may_merge || may_merge(i, j));
    };
    tf::weld_options options{.tolerance = tolerance, .chain = true};
    options.label = label;
    options.may_merge = may_merge;
    CHECK(tf::detail::weld::dense_chains(points, options) ==
          tf::test::brute_chains(points, linked));
}

/// One coordinate more, as `cube_hash` takes it.
std::uint64_t hash_step(std::uint64_t h, std::int64_t i) {
    h = (h + static_cast<std::uint64_t>(i)) * 0x9e3779b97f4a7c15;
    return h ^ h >> 32;
}

}  // namespace

TEST_CASE("dense_chains: those of all pairs, on every family") {
    for (const test::weld_family& f : test::weld_families(3, 600)) {
        if (f.tolerance == 0.0) continue;
        CAPTURE(f.name);
        numbers labels;
        for (std::uint32_t i = 0; i < f.points.size(); ++i) labels.push_back(i * i % 3);
        check_chains(f.points, f.tolerance);
        check_chains(f.points, f.tolerance, labels);
        check_chains(f.points, f.tolerance, {},
                     [](std::uint32_t i, std::uint32_t j) { return (i + j) % 7 != 0; });
    }
}

TEST_CASE("dense_chains: threads that cross cubes and cells, on all sides of zero") {
    constexpr double tolerance = 0.25;
    constexpr double just_within = 0.2499;
    std::mt19937_64 engine(7);
    for (int turn = 0; turn < 40; ++turn) {
        std::vector<point3> points;
        for (int thread = 0; thread < 6; ++thread) {
            point3 at = test::unit_point(engine);
            for (std::size_t k = 0; k < 3; ++k) at[k] = 8.0 * at[k] - 4.0;
            for (int i = 0; i < 60; ++i) {
                points.push_back(at);
                const point3 way = test::moved_by({}, 2.0, engine);
                const double length = std::hypot(way.x, way.y, way.z);
                for (std::size_t k = 0; k < 3; ++k) at[k] += just_within * way[k] / length;
            }
        }
        check_chains(points, tolerance);
    }
}

TEST_CASE("dense_chains: cells of one hash are told apart") {
    // The hash is taken coordinate by coordinate, each time by an addition and a bijection, so a y
    // far away gives two cells one hash.
    constexpr double tolerance = 1.0;
    constexpr double width = tolerance / tf::detail::weld::cubes_per_tolerance;
    constexpr std::int64_t cell_side = 8;
    const auto middle_of_cell = [](std::int64_t cell) {
        return (static_cast<double>(cell_side * cell) + 4.5) * width;
    };
    int found = 0;
    for (std::int64_t x = 1; x < 400; ++x) {
        const auto y = static_cast<std::int64_t>(hash_step(0, 0) - hash_step(0, x));
        const double far = std::bit_cast<double>(static_cast<std::uint64_t>(y) << 3);
        if ((far < 0) != (y < 0) || std::bit_cast<std::int64_t>(far) >> 3 != y) continue;
        if (!std::isfinite(far) || std::abs(far) < 0x1p100) continue;
        REQUIRE(tf::detail::weld::cube_hash(x, y, 0, 0) == tf::detail::weld::cube_hash(0, 0, 0, 0));
        ++found;
        // A thread comes into each of the two cells and leads on, by the same places in them.
        std::vector<point3> points;
        for (int i = -8; i <= 8; ++i) {
            const double along = 0.9 * tolerance * i;
            points.push_back({middle_of_cell(x) + along, far, middle_of_cell(0)});
            points.push_back({middle_of_cell(0) + along, 0.5 * width, middle_of_cell(0)});
        }
        check_chains(points, tolerance);
    }
    CHECK(found > 10);
}

TEST_CASE("dense_chains: progress is told often, and stops the work") {
    std::mt19937_64 engine(8);
    std::vector<point3> points;
    for (int i = 0; i < 60'000; ++i) {
        const point3 p = test::unit_point(engine);
        points.push_back({400.0 * p.x, 400.0 * p.y, p.z});
    }
    tf::weld_options options{.tolerance = 0.2, .chain = true};
    int calls = 0;
    options.progress = [&](double) { return ++calls > 0; };
    CHECK(tf::detail::weld::dense_chains(points, options).size() == points.size());
    CHECK(calls > 5);
    const int all = calls;
    for (int stop = 1; stop < all; ++stop) {
        calls = 0;
        options.progress = [&](double) { return ++calls < stop; };
        CHECK(tf::detail::weld::dense_chains(points, options).empty());
        CHECK(calls == stop);
    }
}

TEST_CASE("dense_chains: points that may not merge take no room in pairs") {
    std::mt19937_64 engine(9);
    std::vector<point3> points;
    for (int i = 0; i < 4'000; ++i) points.push_back(test::unit_point(engine));
    const auto of_class = [](std::uint32_t i, std::uint32_t j) { return i % 50 == j % 50; };
    check_chains(points, 0.05, {}, of_class);
    check_chains(points, 0.3, {}, of_class);
    check_chains(points, 0.3, {}, [](std::uint32_t, std::uint32_t) { return false; });
}
