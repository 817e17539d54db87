#include <libmesh/exact/predicates.hpp>
#include <libmesh/weld/weld_points.hpp>
#include <libtree/parallel.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

namespace {

using tf::neighbor_search;
using tf::point3;
using tf::point_groups;
using tf::weld_options;
using tf::weld_points;
using tf::weld_rule;
using numbers = std::vector<std::uint32_t>;

constexpr std::array searches{neighbor_search::automatic, neighbor_search::window,
                              neighbor_search::cells, neighbor_search::tree};
constexpr std::array rules{weld_rule::first, weld_rule::chain};

bool finite(const point3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

bool linked(const std::vector<point3>& points, const weld_options& options, std::uint32_t i,
            std::uint32_t j) {
    return finite(points[i]) && finite(points[j]) &&
           (options.kind.empty() || options.kind[i] == options.kind[j]) &&
           tf::compare_distance(points[i], points[j], {}, {options.tolerance, 0.0, 0.0}) <= 0 &&
           (!options.agree || options.agree(i, j));
}

/// The docstring of `first` as a quadratic loop: the point that each one belongs to.
numbers leaders_by_definition(const std::vector<point3>& points, const weld_options& options) {
    numbers leader(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        leader[i] = i;
        for (std::uint32_t j = 0; j < i; ++j)
            if (leader[j] == j && linked(points, options, i, j) &&
                (leader[i] == i ||
                 tf::compare_distance(points[i], points[j], points[i], points[leader[i]]) < 0))
                leader[i] = j;
    }
    return leader;
}

/// That of `chain`: labels sink along links until none moves.
numbers chains_by_definition(const std::vector<point3>& points, const weld_options& options) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> links;
    for (std::uint32_t i = 0; i < points.size(); ++i)
        for (std::uint32_t j = 0; j < i; ++j)
            if (linked(points, options, i, j)) links.emplace_back(i, j);
    numbers first(points.size());
    std::iota(first.begin(), first.end(), 0U);
    for (bool moved = true; moved;) {
        moved = false;
        for (const auto& [i, j] : links) {
            if (first[i] == first[j]) continue;
            first[i] = first[j] = std::min(first[i], first[j]);
            moved = true;
        }
    }
    return first;
}

point_groups by_definition(const std::vector<point3>& points, const weld_options& options) {
    const numbers first = options.rule == weld_rule::first ? leaders_by_definition(points, options)
                                                           : chains_by_definition(points, options);
    point_groups groups;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        if (first[i] == i) {
            groups.group_of_point.push_back(
                static_cast<std::uint32_t>(groups.first_of_group.size()));
            groups.first_of_group.push_back(i);
        } else {
            groups.group_of_point.push_back(groups.group_of_point[first[i]]);
        }
    }
    return groups;
}

/// Both rules, by every search, against their definition.
void check_definition(const std::vector<point3>& points, weld_options options) {
    for (const weld_rule rule : rules) {
        options.rule = rule;
        const point_groups expected = by_definition(points, options);
        for (const neighbor_search search : searches) {
            CAPTURE(static_cast<int>(rule));
            CAPTURE(static_cast<int>(search));
            CAPTURE(options.tolerance);
            options.search = search;
            const point_groups groups = weld_points(points, options);
            CHECK(groups.group_of_point == expected.group_of_point);
            CHECK(groups.first_of_group == expected.first_of_group);
            CHECK_FALSE(groups.stopped);
        }
    }
}

double unit_number(std::mt19937_64& engine) {
    return static_cast<double>(engine() >> 11) * 0x1p-53;
}

point3 unit_point(std::mt19937_64& engine) {
    const double x = unit_number(engine);
    const double y = unit_number(engine);
    return {x, y, unit_number(engine)};
}

std::size_t kept(const std::vector<point3>& points, double tolerance) {
    return weld_points(points, {.tolerance = tolerance}).first_of_group.size();
}

}  // namespace

TEST_CASE("weld_points: nothing comes of nothing") {
    for (const double tolerance : {0.0, 1.0}) {
        const point_groups groups = weld_points({}, {.tolerance = tolerance});
        CHECK(groups.group_of_point.empty());
        CHECK(groups.first_of_group.empty());
    }
}

TEST_CASE("weld_points: one point is one group") {
    check_definition({{1, 2, 3}}, {.tolerance = 1.0});
    check_definition({{1, 2, 3}}, {});
}

TEST_CASE("weld_points: the tolerance is inclusive") {
    const double gap = 0.25;
    const std::vector<point3> points{{0, 0, 0}, {gap, 0, 0}};
    CHECK(kept(points, gap) == 1);
    CHECK(kept(points, std::nextafter(gap, 0.0)) == 2);
    const std::vector<point3> diagonal{{0, 0, 0}, {3, 4, 12}};
    CHECK(kept(diagonal, 13.0) == 1);
    CHECK(kept(diagonal, std::nextafter(13.0, 0.0)) == 2);
}

TEST_CASE("weld_points: tolerance 0 joins equal coordinates only") {
    const std::vector<point3> points{{0.0, 1, 2}, {-0.0, 1, 2}, {5e-324, 1, 2}};
    CHECK(weld_points(points, {}).group_of_point == numbers{0, 0, 1});
    check_definition(points, {});
}

TEST_CASE("weld_points: chain follows a chain, first does not") {
    const std::vector<point3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    CHECK(weld_points(points, {.tolerance = 1.0}).group_of_point == numbers{0, 0, 1, 1});
    CHECK(weld_points(points, {.tolerance = 1.0, .rule = weld_rule::chain}).group_of_point ==
          numbers{0, 0, 0, 0});
}

TEST_CASE("weld_points: a point goes to the nearest, the earlier of two as near") {
    const std::vector<point3> points{{0, 0, 0}, {3, 0, 0}, {2, 0, 0}, {1.5, 0, 0}};
    CHECK(weld_points(points, {.tolerance = 2.0}).group_of_point == numbers{0, 1, 1, 0});
    check_definition(points, {.tolerance = 2.0});
}

TEST_CASE("weld_points: points that are not finite stay alone") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    const std::vector<point3> points{{nan, 0, 0}, {nan, 0, 0}, {inf, 0, 0},
                                     {inf, 0, 0}, {0, 0, 0},   {0, 0, 0}};
    for (const double tolerance : {0.0, 1.0}) {
        check_definition(points, {.tolerance = tolerance});
        CHECK(weld_points(points, {.tolerance = tolerance}).group_of_point ==
              numbers{0, 1, 2, 3, 4, 4});
    }
}

TEST_CASE("weld_points: options that cannot be meant are refused") {
    const std::vector<point3> points{{0, 0, 0}};
    for (const double bad :
         {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
        CHECK_THROWS_AS(static_cast<void>(weld_points(points, {.tolerance = bad})),
                        std::invalid_argument);
    const numbers kinds{1, 2};
    CHECK_THROWS_AS(static_cast<void>(weld_points(points, {.kind = kinds})), std::invalid_argument);
}

TEST_CASE("weld_points: kinds and agree keep points apart") {
    const std::vector<point3> points{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}};
    const numbers kinds{0, 1, 0, 1, 1};
    CHECK(weld_points(points, {.kind = kinds}).group_of_point == numbers{0, 1, 0, 2, 2});
    CHECK(weld_points(points, {.tolerance = 1.0, .kind = kinds}).group_of_point ==
          numbers{0, 1, 0, 1, 1});
    const auto agree = [](std::uint32_t i, std::uint32_t j) { return (i + j) % 2 == 0; };
    for (const double tolerance : {0.0, 1.0}) {
        check_definition(points, {.tolerance = tolerance, .kind = kinds});
        check_definition(points, {.tolerance = tolerance, .agree = agree});
        check_definition(points, {.tolerance = tolerance, .kind = kinds, .agree = agree});
    }
}

TEST_CASE("weld_points: agrees with its definition on random points") {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        CAPTURE(seed);
        std::mt19937_64 engine(seed);
        std::vector<point3> points;
        for (int i = 0; i < 300; ++i) points.push_back(unit_point(engine));
        for (const double tolerance : {0.0, 0.01, 0.07, 0.5, 3.0})
            check_definition(points, {.tolerance = tolerance});
    }
}

TEST_CASE("weld_points: agrees with its definition on lattices, where distances tie") {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        CAPTURE(seed);
        std::mt19937_64 engine(seed);
        std::vector<point3> points;
        const auto coordinate = [&] { return static_cast<double>(engine() % 6) * 0.5 - 1.0; };
        for (int i = 0; i < 200; ++i) points.push_back({coordinate(), coordinate(), coordinate()});
        for (const double tolerance : {0.0, 0.5, 0.75, 1.0, 1.5})
            check_definition(points, {.tolerance = tolerance});
    }
}

TEST_CASE("weld_points: scales from denormal to the largest double") {
    std::mt19937_64 engine(7);
    std::vector<point3> unit;
    for (int i = 0; i < 60; ++i)
        unit.push_back({unit_number(engine) - 0.5, unit_number(engine), unit_number(engine)});
    for (const int exponent : {-1060, -900, -300, 0, 300, 1000, 1023}) {
        CAPTURE(exponent);
        std::vector<point3> points;
        for (const point3& p : unit)
            points.push_back(
                {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)});
        check_definition(points, {.tolerance = std::ldexp(0.25, exponent)});
    }
    const double most = std::numeric_limits<double>::max();
    check_definition({{-most, 0, 0}, {most, 0, 0}, {0, 0, 0}, {most, 1, 0}}, {.tolerance = most});
}

TEST_CASE("weld_points: a hundred thousand equal points are one") {
    const std::vector<point3> points(100000, point3{1, 2, 3});
    CHECK(kept(points, 0.0) == 1);
    CHECK(kept(points, 1e-3) == 1);
}

TEST_CASE("join_groups: faces stay, also those that collapse, and kept points are apart") {
    std::mt19937_64 engine(3);
    tf::mesh mesh;
    for (int i = 0; i < 500; ++i)
        mesh.points.push_back({unit_number(engine), unit_number(engine), 0.0});
    for (std::uint32_t i = 0; i + 2 < 500; i += 3) mesh.faces.push_back({i, i + 1, i + 2});
    const auto joined = [](const tf::mesh& m) {
        return tf::join_groups(m, weld_points(m.points, {.tolerance = 0.05}));
    };
    const tf::mesh once = joined(mesh);
    CHECK(once.points.size() < mesh.points.size());
    CHECK(once.faces.size() == mesh.faces.size());
    for (std::uint32_t i = 0; i < once.points.size(); ++i)
        for (std::uint32_t j = 0; j < i; ++j)
            REQUIRE_FALSE(linked(once.points, {.tolerance = 0.05}, i, j));
    CHECK(joined(once) == once);
    CHECK_THROWS_AS(static_cast<void>(tf::join_groups(mesh, point_groups{})),
                    std::invalid_argument);
    mesh.faces.push_back({0, 1, 500});
    CHECK_THROWS_AS(
        static_cast<void>(tf::join_groups(mesh, weld_points(mesh.points, {.tolerance = 0.05}))),
        std::invalid_argument);
}
