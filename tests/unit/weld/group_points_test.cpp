#include <libmesh/weld/group_points.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/brute_weld.hpp>
#include <support/weld_families.hpp>

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

using tf::group_points;
using tf::point3;
using tf::point_groups;
using tf::weld_options;
using tf::detail::weld::find_groups;
using tf::detail::weld::neighbor_search;
using family = test::weld_family;
using numbers = std::vector<std::uint32_t>;

constexpr std::array searches{neighbor_search::automatic, neighbor_search::window,
                              neighbor_search::cells, neighbor_search::tree};
constexpr std::array rules{false, true};

bool finite(const point3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

bool linked(const std::vector<point3>& points, const weld_options& options, std::uint32_t i,
            std::uint32_t j) {
    return finite(points[i]) && finite(points[j]) &&
           (options.label.empty() || options.label[i] == options.label[j]) &&
           tf::compare_distance(points[i], points[j], {}, {options.tolerance, 0.0, 0.0}) <= 0 &&
           (!options.may_merge || options.may_merge(i, j));
}

point_groups by_definition(const std::vector<point3>& points, const weld_options& options) {
    const auto are_linked = [&](std::uint32_t i, std::uint32_t j) {
        return linked(points, options, i, j);
    };
    const numbers first = !options.chain ? tf::test::brute_leaders(points, are_linked)
                                         : tf::test::brute_chains(points, are_linked);
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
    for (const bool chain : rules) {
        options.chain = chain;
        const point_groups expected = by_definition(points, options);
        for (const neighbor_search search : searches) {
            CAPTURE(chain);
            CAPTURE(static_cast<int>(search));
            CAPTURE(options.tolerance);
            const point_groups groups = find_groups("group_points", points, options, search);
            CHECK(groups.group_of_point == expected.group_of_point);
            CHECK(groups.first_of_group == expected.first_of_group);
            CHECK_FALSE(groups.status == tf::status::cancelled);
        }
    }
}

std::size_t kept(const std::vector<point3>& points, double tolerance) {
    return group_points(points, {.tolerance = tolerance}).first_of_group.size();
}

}  // namespace

TEST_CASE("group_points: nothing comes of nothing") {
    for (const double tolerance : {0.0, 1.0}) {
        const point_groups groups = group_points({}, {.tolerance = tolerance});
        CHECK(groups.group_of_point.empty());
        CHECK(groups.first_of_group.empty());
    }
}

TEST_CASE("group_points: one point is one group") {
    check_definition({{1, 2, 3}}, {.tolerance = 1.0});
    check_definition({{1, 2, 3}}, {});
}

TEST_CASE("group_points: the tolerance is inclusive") {
    const double gap = 0.25;
    const std::vector<point3> points{{0, 0, 0}, {gap, 0, 0}};
    CHECK(kept(points, gap) == 1);
    CHECK(kept(points, std::nextafter(gap, 0.0)) == 2);
    const std::vector<point3> diagonal{{0, 0, 0}, {3, 4, 12}};
    CHECK(kept(diagonal, 13.0) == 1);
    CHECK(kept(diagonal, std::nextafter(13.0, 0.0)) == 2);
}

TEST_CASE("group_points: tolerance 0 joins equal coordinates only") {
    const std::vector<point3> points{{0.0, 1, 2}, {-0.0, 1, 2}, {5e-324, 1, 2}};
    CHECK(group_points(points, {}).group_of_point == numbers{0, 0, 1});
    check_definition(points, {});
}

TEST_CASE("group_points: chain follows a chain, first does not") {
    const std::vector<point3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    CHECK(group_points(points, {.tolerance = 1.0}).group_of_point == numbers{0, 0, 1, 1});
    CHECK(group_points(points, {.tolerance = 1.0, .chain = true}).group_of_point ==
          numbers{0, 0, 0, 0});
}

TEST_CASE("group_points: a point goes to the nearest, the earlier of two as near") {
    const std::vector<point3> points{{0, 0, 0}, {3, 0, 0}, {2, 0, 0}, {1.5, 0, 0}};
    CHECK(group_points(points, {.tolerance = 2.0}).group_of_point == numbers{0, 1, 1, 0});
    check_definition(points, {.tolerance = 2.0});
}

TEST_CASE("group_points: points that are not finite stay alone") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    const std::vector<point3> points{{nan, 0, 0}, {nan, 0, 0}, {inf, 0, 0},
                                     {inf, 0, 0}, {0, 0, 0},   {0, 0, 0}};
    for (const double tolerance : {0.0, 1.0}) {
        check_definition(points, {.tolerance = tolerance});
        CHECK(group_points(points, {.tolerance = tolerance}).group_of_point ==
              numbers{0, 1, 2, 3, 4, 4});
    }
}

TEST_CASE("group_points: options that cannot be meant are refused") {
    const std::vector<point3> points{{0, 0, 0}};
    for (const double bad :
         {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
        CHECK_THROWS_AS(static_cast<void>(group_points(points, {.tolerance = bad})),
                        std::invalid_argument);
    const numbers labels{1, 2};
    CHECK_THROWS_AS(static_cast<void>(group_points(points, {.label = labels})),
                    std::invalid_argument);
}

TEST_CASE("group_points: labels and may_merge keep points apart") {
    const std::vector<point3> points{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}};
    const numbers labels{0, 1, 0, 1, 1};
    CHECK(group_points(points, {.label = labels}).group_of_point == numbers{0, 1, 0, 2, 2});
    CHECK(group_points(points, {.tolerance = 1.0, .label = labels}).group_of_point ==
          numbers{0, 1, 0, 1, 1});
    const auto may_merge = [](std::uint32_t i, std::uint32_t j) { return (i + j) % 2 == 0; };
    for (const double tolerance : {0.0, 1.0}) {
        check_definition(points, {.tolerance = tolerance, .label = labels});
        check_definition(points, {.tolerance = tolerance, .may_merge = may_merge});
        check_definition(points, {.tolerance = tolerance, .label = labels, .may_merge = may_merge});
    }
}

TEST_CASE("group_points: agrees with its definition on random points") {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        CAPTURE(seed);
        std::mt19937_64 engine(seed);
        std::vector<point3> points;
        for (int i = 0; i < 300; ++i) points.push_back(test::unit_point(engine));
        for (const double tolerance : {0.0, 0.01, 0.07, 0.5, 3.0})
            check_definition(points, {.tolerance = tolerance});
    }
}

TEST_CASE("group_points: agrees with its definition on lattices, where distances tie") {
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

TEST_CASE("group_points: scales from denormal to the largest double") {
    std::mt19937_64 engine(7);
    std::vector<point3> unit;
    for (int i = 0; i < 60; ++i)
        unit.push_back({test::unit_number(engine) - 0.5, test::unit_number(engine),
                        test::unit_number(engine)});
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

TEST_CASE("group_points: a hundred thousand equal points are one") {
    const std::vector<point3> points(100000, point3{1, 2, 3});
    CHECK(kept(points, 0.0) == 1);
    CHECK(kept(points, 1e-3) == 1);
}

TEST_CASE("join_groups: faces stay, also those that collapse, and kept points are apart") {
    std::mt19937_64 engine(3);
    tf::mesh mesh;
    for (int i = 0; i < 500; ++i)
        mesh.points.push_back({test::unit_number(engine), test::unit_number(engine), 0.0});
    for (std::uint32_t i = 0; i + 2 < 500; i += 3) mesh.faces.push_back({i, i + 1, i + 2});
    const auto joined = [](const tf::mesh& m) {
        return group_points(m.points, {.tolerance = 0.05}).joined(m);
    };
    const tf::mesh once = joined(mesh);
    CHECK(once.points.size() < mesh.points.size());
    CHECK(once.faces.size() == mesh.faces.size());
    for (std::uint32_t i = 0; i < once.points.size(); ++i)
        for (std::uint32_t j = 0; j < i; ++j)
            REQUIRE_FALSE(linked(once.points, {.tolerance = 0.05}, i, j));
    CHECK(joined(once) == once);
    CHECK_THROWS_AS(static_cast<void>(point_groups{}.joined(mesh)), std::invalid_argument);
    mesh.faces.push_back({0, 1, 500});
    CHECK_THROWS_AS(static_cast<void>(group_points(mesh.points, {.tolerance = 0.05}).joined(mesh)),
                    std::invalid_argument);
}

namespace {

weld_options options_of(double tolerance, bool chain) {
    return {.tolerance = tolerance, .chain = chain};
}

point_groups groups_by(neighbor_search search, const family& f, bool chain) {
    return find_groups("group_points", f.points, options_of(f.tolerance, chain), search);
}

}  // namespace

TEST_CASE("group_points: every search and rule is its definition on every family") {
    for (std::uint64_t seed = 0; seed < 2; ++seed)
        for (const family& f : test::weld_families(seed, 240)) {
            CAPTURE(seed);
            CAPTURE(f.name);
            check_definition(f.points, {.tolerance = f.tolerance});
            numbers labels;
            for (std::uint32_t i = 0; i < f.points.size(); ++i) labels.push_back(i * i % 3);
            check_definition(f.points, {.tolerance = f.tolerance, .label = labels});
            const auto may_merge = [](std::uint32_t i, std::uint32_t j) {
                return (i + j) % 7 != 0;
            };
            check_definition(f.points, {.tolerance = f.tolerance, .may_merge = may_merge});
        }
}

TEST_CASE("group_points: kept points are apart, dropped ones with the nearest earlier kept one") {
    for (const family& f : test::weld_families(5, 700)) {
        CAPTURE(f.name);
        const point_groups groups = group_points(f.points, {.tolerance = f.tolerance});
        const weld_options options{.tolerance = f.tolerance};
        for (std::uint32_t i = 0; i < f.points.size(); ++i) {
            const std::uint32_t own = groups.first_of_group[groups.group_of_point[i]];
            REQUIRE((own == i || linked(f.points, options, i, own)));
            for (const std::uint32_t kept : groups.first_of_group) {
                if (kept >= i) break;
                if (own == i)
                    REQUIRE_FALSE(linked(f.points, options, i, kept));
                else
                    REQUIRE(tf::compare_distance(f.points[i], f.points[own], f.points[i],
                                                 f.points[kept]) <= 0);
            }
        }
        std::vector<point3> once;
        for (const std::uint32_t i : groups.first_of_group) once.push_back(f.points[i]);
        CHECK(group_points(once, options).first_of_group.size() == once.size());
    }
}

TEST_CASE("group_points: the number of threads changes nothing") {
    std::vector<family> all = test::weld_families(11, 3'000);
    const std::vector<family> large =
        test::weld_families(12, 100'000);  // several chunks of every loop
    all.insert(all.end(), large.begin() + 1, large.begin() + 3);
    all.back().tolerance = 1e-4;
    for (const family& f : all)
        for (const bool chain : rules)
            for (const neighbor_search search : searches) {
                CAPTURE(f.name);
                point_groups one;
                for (const unsigned threads : {1U, 2U, 8U}) {
                    if (threads == 8 && search == neighbor_search::tree) continue;
                    const tf::thread_scope scope(threads);
                    const point_groups found = groups_by(search, f, chain);
                    if (threads == 1) one = found;
                    REQUIRE(found.group_of_point == one.group_of_point);
                    REQUIRE(found.first_of_group == one.first_of_group);
                }
            }
}

TEST_CASE("group_points: searches agree on many points") {
    for (const family& f : test::weld_families(13, 4'000))
        for (const bool chain : rules) {
            CAPTURE(f.name);
            const point_groups expected = groups_by(neighbor_search::tree, f, chain);
            for (const neighbor_search search : searches)
                REQUIRE(groups_by(search, f, chain).group_of_point == expected.group_of_point);
        }
}

TEST_CASE("group_points: powers of two scale nothing away") {
    for (const family& f : test::weld_families(17, 500)) {
        if (f.points[0].x == 1e300) continue;  // has no room
        for (const bool chain : rules) {
            CAPTURE(f.name);
            const point_groups expected = group_points(f.points, options_of(f.tolerance, chain));
            for (const int exponent : {-900, -200, 13, 700, 990}) {
                std::vector<point3> scaled;
                for (const point3& p : f.points)
                    scaled.push_back({std::ldexp(p.x, exponent), std::ldexp(p.y, exponent),
                                      std::ldexp(p.z, exponent)});
                const double tolerance = std::ldexp(f.tolerance, exponent);
                REQUIRE(group_points(scaled, options_of(tolerance, chain)).group_of_point ==
                        expected.group_of_point);
            }
        }
    }
}

TEST_CASE("group_points: chains do not depend on the order of points") {
    for (const family& f : test::weld_families(19, 2'000)) {
        CAPTURE(f.name);
        numbers order(f.points.size());
        std::iota(order.begin(), order.end(), 0U);
        std::mt19937_64 engine(1);
        for (std::size_t i = order.size() - 1; i > 0; --i)
            std::swap(order[i], order[engine() % (i + 1)]);
        std::vector<point3> shuffled;
        for (const std::uint32_t i : order) shuffled.push_back(f.points[i]);
        const point_groups given = group_points(f.points, options_of(f.tolerance, true));
        const point_groups found = group_points(shuffled, options_of(f.tolerance, true));
        REQUIRE(found.first_of_group.size() == given.first_of_group.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) {  // one group of one is one of the other
            const std::uint32_t first = order[found.first_of_group[found.group_of_point[i]]];
            REQUIRE(given.group_of_point[order[i]] == given.group_of_point[first]);
        }
    }
}

TEST_CASE("group_points: many labels at one place take no time") {
    constexpr std::uint32_t count = 50'000;
    const std::vector<point3> points(count, {1, 2, 3});
    numbers labels(count);
    for (std::uint32_t i = 0; i < count; ++i) labels[i] = i % (count / 2);
    for (const bool chain : rules)
        for (const double tolerance : {0.0, 1e-3}) {
            const point_groups groups =
                group_points(points, {.tolerance = tolerance, .chain = chain, .label = labels});
            REQUIRE(groups.first_of_group.size() == count / 2);
            CHECK(groups.group_of_point[count - 1] == count / 2 - 1);
        }
}

TEST_CASE("group_points: may_merge is asked about equal points, too, and most may agree") {
    const std::size_t count = 20'000;
    const std::vector<point3> points(count, {1, 2, 3});
    const auto may_merge = [](std::uint32_t i, std::uint32_t j) { return (i == 5) == (j == 5); };
    for (const bool chain : rules)
        for (const double tolerance : {0.0, 1e-3}) {
            const point_groups groups = group_points(
                points, {.tolerance = tolerance, .chain = chain, .may_merge = may_merge});
            CHECK(groups.first_of_group == numbers{0, 5});
        }
}

TEST_CASE("group_points: progress never decreases, and stops the work when it says so") {
    for (const family& f : test::weld_families(23, 3'000))
        for (const bool chain : rules) {
            CAPTURE(f.name);
            weld_options options = options_of(f.tolerance, chain);
            double last = 0.0;
            int calls = 0;
            options.progress = [&](double done) {
                CHECK(done >= last);
                CHECK(done <= 1.0);
                last = done;
                ++calls;
                return true;
            };
            CHECK_FALSE(group_points(f.points, options).status == tf::status::cancelled);
            CHECK(last == 1.0);
            for (int stop = 0; stop < calls; ++stop) {
                int left = stop;
                options.progress = [&](double) { return left-- > 0; };
                const point_groups groups = group_points(f.points, options);
                CHECK(groups.status == tf::status::cancelled);
                CHECK(groups.group_of_point.empty());
                CHECK(groups.first_of_group.empty());
            }
        }
}

TEST_CASE("group_points: points that are not finite are nearly equal to none, and never fewer") {
    const double infinite = std::numeric_limits<double>::infinity();
    for (const double x : {infinite, -infinite, std::numeric_limits<double>::quiet_NaN()}) {
        std::vector<tf::point3> points(5, {x, x, x});
        CHECK(tf::count_nearly_equal(points, 1.0) == 0);
        points.insert(points.end(), {{0, 0, 0}, {-0.0, 0, 0}, {0, 0, 0.5}});
        CHECK(tf::count_nearly_equal(points, 1.0) == 1);
    }
}
