#include <libmesh/base/max_displacement.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/pack.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>
#include <support/tubes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace {

constexpr double any_height = std::numeric_limits<double>::infinity();

std::vector<tf::mesh_view> views(const std::vector<tf::mesh>& parts) {
    return {parts.begin(), parts.end()};
}

/// A prism over a polygon that goes around to the left, standing on z = 0; `triangles` cut it.
tf::mesh prism(const std::vector<std::array<double, 2>>& outline,
               const std::vector<tf::face>& triangles, double height) {
    tf::mesh mesh;
    const auto n = static_cast<std::uint32_t>(outline.size());
    for (const double z : {0.0, height})
        for (const auto& [x, y] : outline) mesh.points.push_back({x, y, z});
    for (const auto& [a, b, c] : triangles)
        mesh.faces.insert(mesh.faces.end(), {{a, c, b}, {a + n, b + n, c + n}});
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        mesh.faces.insert(mesh.faces.end(), {{i, j, j + n}, {i, j + n, i + n}});
    }
    return mesh;
}

/// Three quarters of a square of two `arm`s a side: the upper right one is not there.
tf::mesh angle_piece(double arm, double height) {
    return prism({{0, 0}, {2 * arm, 0}, {2 * arm, arm}, {arm, arm}, {arm, 2 * arm}, {0, 2 * arm}},
                 {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}}, height);
}

/// An arch over the y axis: 3 `leg`s wide, 2 high.
tf::mesh arch(double leg, double depth) {
    tf::mesh mesh =
        prism({{0, 0},
               {leg, 0},
               {leg, leg},
               {2 * leg, leg},
               {2 * leg, 0},
               {3 * leg, 0},
               {3 * leg, 2 * leg},
               {0, 2 * leg}},
              {{0, 1, 2}, {0, 2, 7}, {2, 6, 7}, {2, 3, 6}, {3, 5, 6}, {3, 4, 5}}, depth);
    for (tf::point3& p : mesh.points) p = {p.x, depth - p.z, p.y};
    return mesh;
}

/// What the header says of what `arrange` returns, by looking at all pairs.
void check_packed(const std::vector<tf::mesh>& parts, const tf::pack_options& o,
                  const tf::packing& found) {
    REQUIRE(found);
    REQUIRE(found.parts.size() == parts.size());
    CHECK(found.certificate.precision == o.precision);
    double moved = 0.0;
    const bool single = o.precision == tf::precision::float32;
    const double unit = single ? 0x1p-24 : 0x1p-53;
    std::vector<std::uint32_t> not_placed;
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
        const tf::packed_part& one = found.parts[i];
        REQUIRE(one.points.size() == parts[i].points.size());
        moved =
            std::max(moved, tf::detail::max_displacement(parts[i].points, one.matrix, one.points));
        if (!one.placed) {
            not_placed.push_back(i);
            CHECK(one.points == parts[i].points);
            CHECK(one.matrix == tf::transform<3>{});
            continue;
        }
        const tf::box3 box = *tf::bounding_box(one.points);
        if (!o.stack) CHECK(box.min.z == found.bed);
        CHECK(box.min.z >= found.bed);
        CHECK(one.plate < found.plates_used);
        CHECK(found.bed >= o.corner.z);
        CHECK(found.bed - o.corner.z <= (single ? 0x1p-23 * std::abs(o.corner.z) : 0.0));
        for (std::size_t k = 0; k < 2; ++k) {
            const double corner = o.corner[k] + one.plate * o.plate_step[k];
            CHECK(box.min[k] >= corner);
            CHECK(box.max[k] - corner <= o.size[k]);
        }
        CHECK(box.max.z - (o.stack ? o.corner.z : box.min.z) <= o.size.z);
        double largest = 0.0;
        for (std::size_t v = 0; v < one.points.size(); ++v)
            for (std::size_t k = 0; k < 3; ++k)
                largest = std::max(
                    {largest, std::abs(one.points[v][k]), std::abs(parts[i].points[v][k])});
        for (std::size_t v = 0; v < one.points.size(); ++v) {
            const tf::point3 q = one.matrix(parts[i].points[v]);
            for (std::size_t k = 0; k < 3; ++k) {
                CHECK(std::abs(q[k] - one.points[v][k]) <= 16 * unit * largest);
                if (single) CHECK(one.points[v][k] == double{static_cast<float>(one.points[v][k])});
            }
        }
    }
    CHECK(found.not_placed == not_placed);
    CHECK(found.certificate.max_displacement == moved);
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            if (!found.parts[i].placed || !found.parts[j].placed) continue;
            const tf::mesh a{found.parts[i].points, parts[i].faces};
            const tf::mesh b{found.parts[j].points, parts[j].faces};
            const auto nearest = tf::closest_pair(a, b);
            if (!nearest || found.parts[i].plate != found.parts[j].plate) continue;
            CAPTURE(i);
            CAPTURE(j);
            CHECK(tf::relation(a, b).relation != tf::mesh_relation::penetrating);
            CHECK(nearest->distance >= o.spacing * (1.0 - 1e-13));
        }
}

std::vector<tf::mesh> mixed_parts(test::random& source, std::size_t count) {
    std::vector<tf::mesh> parts;
    for (std::size_t i = 0; i < count; ++i) {
        tf::mesh mesh;
        if (i % 4 == 0) mesh = test::box(source.in(5, 30), source.in(5, 20), source.in(1, 9));
        if (i % 4 == 1) mesh = test::ball(2, source.in(2, 8));
        if (i % 4 == 2) mesh = test::tube(source.in(8, 12), source.in(4, 7), 3, 24);
        if (i % 4 == 3)  // an L
            mesh = test::together(test::box(20, 4, 3), test::box(4, 15, 3));
        parts.push_back(test::moved(mesh, {source.in(-50, 50), source.in(-50, 50), 7}));
    }
    return parts;
}

}  // namespace

TEST_CASE("pack: no parts, and parts without points, take no room") {
    CHECK(tf::pack(std::vector<tf::mesh_view>{}, {.size = {10, 10, any_height}}).parts.empty());
    const auto found = tf::pack(std::vector<tf::mesh>(2), {.size = {10, 10, any_height}});
    CHECK(found.parts[0].placed);
    CHECK(found.not_placed.empty());
    const std::vector<tf::point3> cloud{{1, 2, 3}, {500, 0, 0}};
    CHECK(tf::pack(cloud, {.size = {10, 10, any_height}}).not_placed.size() == 1);
    CHECK(tf::pack(cloud, {.size = {510, 10, any_height}}).not_placed.empty());
}

TEST_CASE("pack: equal boxes come in rows, exactly the spacing apart") {
    const std::vector<tf::mesh> parts(12, test::moved(test::box(20, 20, 5), {-7, 100, 3}));
    // 4 boxes and 3 gaps are 86: not a hair to spare
    const tf::pack_options options{.size = {86, 64, any_height}};
    const auto found = tf::pack(views(parts), options);
    check_packed(parts, options, found);
    CHECK(found.not_placed.empty());
    std::set<std::pair<double, double>> corners;
    for (const tf::packed_part& part : found.parts) {
        const tf::box3 box = *tf::bounding_box(part.points);
        corners.emplace(box.min.x, box.min.y);
    }
    REQUIRE(corners.size() == 12);
    for (const auto& [x, y] : corners) {
        CHECK(std::abs(x / 22 - std::round(x / 22)) < 1e-13);
        CHECK(std::abs(y / 22 - std::round(y / 22)) < 1e-13);
    }
    // one less does not do
    const tf::pack_options smaller{.size = {std::nextafter(86.0, 0.0), 64, any_height}};
    const auto fewer = tf::pack(views(parts), smaller);
    check_packed(parts, smaller, fewer);
    CHECK(fewer.not_placed.size() == 3);
}

TEST_CASE("pack: a part as large as the plate fits, turned if need be; a larger one does not") {
    const std::vector<tf::mesh> parts{test::box(30, 100, 20)};
    const auto placed = [&](const tf::pack_options& o) {
        const auto found = tf::pack(views(parts), o);
        check_packed(parts, o, found);
        return found.not_placed.empty();
    };
    CHECK(placed({.size = {30, 100, 20}, .turns = 1}));
    CHECK(placed({.size = {100, 30, 20}}));
    CHECK_FALSE(placed({.size = {100, 30, 20}, .turns = 1}));
    CHECK_FALSE(placed({.size = {std::nextafter(30.0, 0.0), 100, 20}}));
    CHECK_FALSE(placed({.size = {100, 100, std::nextafter(20.0, 0.0)}}));
    CHECK_FALSE(placed({.size = {0, 0, 20}}));
    // across: 100 x 30 at 45 degrees is 92 wide
    CHECK_FALSE(placed({.size = {93, 93, 20}}));
    CHECK(placed({.size = {93, 93, 20}, .turns = 8}));
}

TEST_CASE("pack: parts stand in the holes of others when they are small enough") {
    const std::vector<tf::mesh> parts{test::tube(50, 40, 10, 48), test::box(40, 40, 30)};
    const tf::pack_options options{.size = {101, 101, any_height}, .spacing = 3};
    const auto found = tf::pack(views(parts), options);
    check_packed(parts, options, found);
    CHECK(found.not_placed.empty());
    CHECK(found.pairs_measured > 0);
    const std::vector<tf::mesh> larger{parts[0], test::box(60, 60, 30)};
    const auto other = tf::pack(views(larger), options);
    check_packed(larger, options, other);
    CHECK(other.not_placed.size() == 1);
}

TEST_CASE("pack: angle pieces and rings that fit only into each other are placed") {
    const std::vector<tf::mesh> two(2, angle_piece(10, 5));
    for (const double spacing : {0.5, 2.0, 4.0}) {
        CAPTURE(spacing);
        // One turned around, in the other: side by side they would be 40 + spacing long.
        const tf::pack_options options{
            .size = {30 + spacing + 1e-3, 20 + spacing + 1e-3, any_height}, .spacing = spacing};
        const auto found = tf::pack(views(two), options);
        check_packed(two, options, found);
        CHECK(found.not_placed.empty());
    }
    std::vector<tf::mesh> rings;
    for (const double outer : {50.0, 40.0, 30.0, 20.0})
        rings.push_back(test::tube(outer, outer - 7.0, 10, 64));
    const tf::pack_options options{.size = {100.5, 100.5, any_height}, .spacing = 2};
    const auto found = tf::pack(views(rings), options);
    check_packed(rings, options, found);
    CHECK(found.not_placed.empty());
}

TEST_CASE("pack: stacked boxes fill a box to its height, and not one more") {
    const std::vector<tf::mesh> parts(28, test::box(20, 20, 20));
    for (const auto precision : {tf::precision::float64, tf::precision::float32}) {
        const tf::pack_options options{.size = {64, 64, 64},
                                       .corner = {-5, 3, 7},
                                       .stack = true,
                                       .tries = 2,
                                       .precision = precision};
        const auto found = tf::pack(views(parts), options);
        check_packed(parts, options, found);
        CHECK(found.not_placed.size() == 1);
        CHECK(found.tries == 2);
    }
    const std::vector<tf::mesh> eight(8, parts[0]);
    const tf::pack_options flat{.size = {64, 42, 64}};
    CHECK(tf::pack(views(eight), flat).not_placed.size() == 2);
    tf::pack_options high = flat;
    high.stack = true;
    const auto found = tf::pack(views(eight), high);
    check_packed(eight, high, found);
    CHECK(found.not_placed.empty());
}

TEST_CASE("pack: stacked, a part goes under an arch, into a ring, and into no closed hollow") {
    const std::vector<tf::mesh> under{arch(10, 10), test::box(7, 9, 7)};
    const tf::pack_options options{.size = {30.5, 10.5, 20.5}, .spacing = 0.5, .stack = true};
    const auto found = tf::pack(views(under), options);
    check_packed(under, options, found);
    CHECK(found.not_placed.empty());

    const std::vector<tf::mesh> in_ring{test::tube(20, 15, 30, 32), test::ball(3, 5),
                                        test::ball(3, 5)};
    const tf::pack_options tube{.size = {40, 40, 30}, .spacing = 1, .stack = true};
    const auto filled = tf::pack(views(in_ring), tube);
    check_packed(in_ring, tube, filled);
    CHECK(filled.not_placed.empty());

    tf::mesh hollow = test::ball(3, 19);
    for (auto& [a, b, c] : hollow.faces) std::swap(a, b);
    const std::vector<tf::mesh> shell{test::together(test::ball(3, 20), hollow), test::ball(3, 8)};
    const tf::pack_options around{.size = {40, 40, 40}, .spacing = 1, .stack = true};
    const auto kept = tf::pack(views(shell), around);
    check_packed(shell, around, kept);
    CHECK(kept.not_placed == std::vector<std::uint32_t>{1});
}

TEST_CASE("pack: stacked parts of all kinds keep the spacing in the coordinates written") {
    test::random source(5);
    std::size_t placed = 0;
    for (int round = 0; round < 5; ++round) {
        CAPTURE(round);
        const std::vector<tf::mesh> parts = mixed_parts(source, 8 + source.below(8));
        tf::pack_options options;
        options.size = {source.in(30, 50), source.in(30, 50), source.in(15, 40)};
        options.corner = {source.in(-9, 9), source.in(-9, 9), source.in(-9, 9)};
        options.spacing = round == 0 ? 0.0 : source.in(0.1, 3.0);
        options.stack = true;
        options.tries = 2;
        options.precision = round % 2 == 1 ? tf::precision::float32 : tf::precision::float64;
        const auto found = tf::pack(views(parts), options);
        check_packed(parts, options, found);
        placed += parts.size() - found.not_placed.size();
        CHECK(found.density > 0.0);
        CHECK(found.density <= 1.0);
    }
    CHECK(placed > 25);
}

TEST_CASE("pack: what is too much for a plate goes to the next, as many as there are") {
    const std::vector<tf::mesh> parts(10, test::box(20, 20, 5));
    tf::pack_options options{.size = {42, 42, any_height}, .plates = 5, .plate_step = {50, 0, 0}};
    const auto found = tf::pack(views(parts), options);
    check_packed(parts, options, found);
    CHECK(found.not_placed.empty());
    CHECK(found.plates_used == 3);
    CHECK(found.tries == 1);
    std::array<int, 3> count{};
    for (const tf::packed_part& part : found.parts) ++count.at(part.plate);
    CHECK(count == std::array{4, 4, 2});
    CHECK(found.message() == "10 of 10 parts placed on 3 plates");
    options.plates = 2;
    options.tries = 3;
    const auto fewer = tf::pack(views(parts), options);
    check_packed(parts, options, fewer);
    CHECK(fewer.not_placed == std::vector<std::uint32_t>{8, 9});
    CHECK(fewer.message() ==
          "8 of 10 parts placed on 2 plates; no arrangement of all was found in 3 tries");
}

TEST_CASE("pack: more tries place more, and what is said of them holds") {
    test::random source(7);
    std::size_t first = 0, all = 0;
    for (int round = 0; round < 6; ++round) {
        CAPTURE(round);
        const std::vector<tf::mesh> parts = mixed_parts(source, 9);
        tf::pack_options options{.size = {52, 52, any_height}, .spacing = 1, .tries = 1};
        const auto once = tf::pack(views(parts), options);
        CHECK(once.tries == 1);
        options.tries = 40;
        const auto often = tf::pack(views(parts), options);
        check_packed(parts, options, often);
        CHECK(often.not_placed.size() <= once.not_placed.size());
        if (!often.not_placed.empty()) CHECK(often.tries == 40);
        first += once.not_placed.size();
        all += often.not_placed.size();
        options.seconds = 0.0;
        const auto hurried = tf::pack(views(parts), options);
        CHECK(hurried.tries == 1);
        CHECK(hurried.not_placed == once.not_placed);
    }
    MESSAGE("not placed in 1 try ", first, ", in 40 tries ", all);
    CHECK(all < first);
}

TEST_CASE("pack: no two parts nearer than the spacing, none off the plate, whatever they are") {
    test::random source(1);
    std::size_t placed = 0, left = 0;
    for (int round = 0; round < 8; ++round) {
        CAPTURE(round);
        const std::vector<tf::mesh> parts = mixed_parts(source, 3 + source.below(7));
        tf::pack_options options;
        options.size = {source.in(30, 70), source.in(30, 70), round % 3 == 0 ? 12 : any_height};
        options.corner = round % 2 == 0 ? tf::point3{} : tf::point3{-30.1, 12.3, 0.7};
        if (round == 7) options.corner = {1e5, -1e5, 1e5};
        options.spacing = round % 5 == 0 ? 0.0 : source.in(0.1, 4.0);
        options.turns = std::array{1U, 4U, 8U, 24U}[round % 4];
        options.tighten = round % 6 != 5;
        options.precision = round % 2 == 1 ? tf::precision::float32 : tf::precision::float64;
        const auto found = tf::pack(views(parts), options);
        check_packed(parts, options, found);
        placed += parts.size() - found.not_placed.size();
        left += found.not_placed.size();
    }
    CHECK(placed > 20);
    CHECK(left > 0);
}

TEST_CASE("pack: the same on any number of threads, and in every run") {
    test::random source(2);
    const std::vector<tf::mesh> parts = mixed_parts(source, 6);
    const tf::pack_options options{.size = {40, 40, any_height}, .turns = 24, .tries = 10};
    const auto one = tf::pack(views(parts), options);
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        const auto other = tf::pack(views(parts), options);
        CHECK(other.not_placed == one.not_placed);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            CHECK(other.parts[i].points == one.parts[i].points);
            CHECK(other.parts[i].matrix == one.parts[i].matrix);
        }
    }
}

TEST_CASE("pack: what cannot be meant is refused, and the part is named") {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<tf::mesh> parts(3, test::box(1, 1, 1));
    const auto refused = [&](const tf::pack_options& o) {
        CHECK_THROWS_AS(static_cast<void>(tf::pack(views(parts), o)), std::invalid_argument);
    };
    refused({.size = {10, -1, 10}});
    refused({.size = {10, 10, 10}, .turns = 0});
    refused({.size = {10, 10, 10}, .turns = 5});
    refused({.size = {10, any_height, 10}});
    refused({.size = {10, 10, nan}});
    refused({.size = {10, 10, 10}, .corner = {nan, 0, 0}});
    refused({.size = {10, 10, 10}, .spacing = -1});
    refused({.size = {10, 10, 10}, .spacing = nan});
    refused({.size = {10, 10, 10}, .tries = 0});
    refused({.size = {10, 10, 10}, .plates = 0});
    refused({.size = {10, 10, 10}, .plates = 2, .plate_step = {nan, 0, 0}});
    refused({.size = {10, 10, 10}, .seconds = nan});
    refused({.size = {10, 10, any_height}, .stack = true});
    parts[1].points[3].x = nan;
    CHECK_THROWS_WITH_AS(static_cast<void>(tf::pack(views(parts), {.size = {10, 10, 10}})),
                         doctest::Contains("part 1"), std::invalid_argument);
    parts[1] = test::box(1e308, 1e308, 1e308);
    parts[2] = test::box(1e-308, 1e-308, 1e-308);
    const auto found = tf::pack(views(parts), {.size = {10, 10, 10}});
    CHECK(found.not_placed == std::vector<std::uint32_t>{1});
}

TEST_CASE("pack: a plate without a height is as high as need be") {
    const std::vector<tf::mesh> parts(3, test::box(1, 1, 1));
    const auto found = tf::pack(views(parts), {.size = {100, 100}});
    CHECK(found.not_placed.empty());
}
