#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/pack.hpp>
#include <treeform/mesh/rounding.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

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

using tf::plate_turns;

constexpr double any_height = std::numeric_limits<double>::infinity();

std::vector<tf::mesh_view> views(const std::vector<tf::mesh>& parts) {
    return {parts.begin(), parts.end()};
}

/// A ring of square section, axis up.
tf::mesh ring(double outer, double inner, double height, std::uint32_t corners) {
    tf::mesh mesh;
    for (std::uint32_t i = 0; i < corners; ++i) {
        const double angle = 2.0 * 3.14159265358979323846 * i / corners;
        const double c = std::cos(angle), s = std::sin(angle);
        mesh.points.insert(mesh.points.end(), {{outer * c, outer * s, 0},
                                               {outer * c, outer * s, height},
                                               {inner * c, inner * s, height},
                                               {inner * c, inner * s, 0}});
        for (std::uint32_t k = 0; k < 4; ++k) {
            const std::uint32_t j = (i + 1) % corners, l = (k + 1) % 4;
            mesh.faces.push_back({4 * i + k, 4 * j + k, 4 * j + l});
            mesh.faces.push_back({4 * i + k, 4 * j + l, 4 * i + l});
        }
    }
    return mesh;
}

/// What the header says of what `arrange` returns, by looking at all pairs.
void check(const std::vector<tf::mesh>& parts, const tf::pack_options& o,
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
        moved = std::max(moved, tf::max_displacement(parts[i].points, one.matrix, one.points));
        if (!one.placed) {
            not_placed.push_back(i);
            CHECK(one.points == parts[i].points);
            CHECK(one.matrix == tf::transform<3>{});
            continue;
        }
        const tf::box3 box = *tf::bounding_box(one.points);
        CHECK(box.min.z == found.bed);
        CHECK(found.bed >= o.corner.z);
        CHECK(found.bed - o.corner.z <= (single ? 0x1p-23 * std::abs(o.corner.z) : 0.0));
        for (std::size_t k = 0; k < 2; ++k) {
            CHECK(box.min[k] >= o.corner[k]);
            CHECK(box.max[k] - o.corner[k] <= o.size[k]);
        }
        CHECK(box.max.z - box.min.z <= o.size.z);
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
            const auto nearest = tf::closest_points(a, b);
            if (!nearest) continue;
            CAPTURE(i);
            CAPTURE(j);
            CHECK(nearest->distance >= o.spacing * (1.0 - 1e-13));
        }
}

std::vector<tf::mesh> mixed_parts(test::random& source, std::size_t count) {
    std::vector<tf::mesh> parts;
    for (std::size_t i = 0; i < count; ++i) {
        tf::mesh mesh;
        if (i % 4 == 0) mesh = test::box(source.in(5, 30), source.in(5, 20), source.in(1, 9));
        if (i % 4 == 1) mesh = test::ball(2, source.in(2, 8));
        if (i % 4 == 2) mesh = ring(source.in(8, 12), source.in(4, 7), 3, 24);
        if (i % 4 == 3)  // an L
            mesh = test::together(test::box(20, 4, 3), test::box(4, 15, 3));
        parts.push_back(test::moved(mesh, {source.in(-50, 50), source.in(-50, 50), 7}));
    }
    return parts;
}

}  // namespace

TEST_CASE("pack: no parts, and parts without faces, take no room") {
    CHECK(tf::pack(std::vector<tf::mesh_view>{}, {.size = {10, 10, any_height}}).parts.empty());
    const std::vector<tf::mesh> cloud{{{{1, 2, 3}, {500, 0, 0}}, {}}};
    const auto found = tf::pack(views(cloud), {.size = {10, 10, any_height}});
    CHECK(found.parts[0].placed);
    CHECK(found.parts[0].points == cloud[0].points);
    CHECK(found.not_placed.empty());
}

TEST_CASE("pack: equal boxes come in rows, exactly the spacing apart") {
    const std::vector<tf::mesh> parts(12, test::moved(test::box(20, 20, 5), {-7, 100, 3}));
    // 4 boxes and 3 gaps are 86: not a hair to spare
    const tf::pack_options options{.size = {86, 64, any_height}};
    const auto found = tf::pack(views(parts), options);
    check(parts, options, found);
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
    check(parts, smaller, fewer);
    CHECK(fewer.not_placed.size() == 3);
}

TEST_CASE("pack: a part as large as the plate fits, turned if need be; a larger one does not") {
    const std::vector<tf::mesh> parts{test::box(30, 100, 20)};
    const auto placed = [&](const tf::pack_options& o) {
        const auto found = tf::pack(views(parts), o);
        check(parts, o, found);
        return found.not_placed.empty();
    };
    CHECK(placed({.size = {30, 100, 20}, .turns = plate_turns::none}));
    CHECK(placed({.size = {100, 30, 20}}));
    CHECK_FALSE(placed({.size = {100, 30, 20}, .turns = plate_turns::none}));
    CHECK_FALSE(placed({.size = {std::nextafter(30.0, 0.0), 100, 20}}));
    CHECK_FALSE(placed({.size = {100, 100, std::nextafter(20.0, 0.0)}}));
    CHECK_FALSE(placed({.size = {0, 0, 20}}));
    // across: 100 x 30 at 45 degrees is 92 wide
    CHECK_FALSE(placed({.size = {93, 93, 20}}));
    CHECK(placed({.size = {93, 93, 20}, .turns = plate_turns::eighth}));
}

TEST_CASE("pack: parts stand in the holes of others when they are small enough") {
    const std::vector<tf::mesh> parts{ring(50, 40, 10, 48), test::box(40, 40, 30)};
    const tf::pack_options options{.size = {101, 101, any_height}, .spacing = 3};
    const auto found = tf::pack(views(parts), options);
    check(parts, options, found);
    CHECK(found.not_placed.empty());
    CHECK(found.pairs_measured > 0);
    const std::vector<tf::mesh> larger{parts[0], test::box(60, 60, 30)};
    const auto other = tf::pack(views(larger), options);
    check(larger, options, other);
    CHECK(other.not_placed.size() == 1);
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
        options.turns = static_cast<plate_turns>(round % 4);
        options.tighten = round % 6 != 5;
        options.precision = round % 2 == 1 ? tf::precision::float32 : tf::precision::float64;
        const auto found = tf::pack(views(parts), options);
        check(parts, options, found);
        placed += parts.size() - found.not_placed.size();
        left += found.not_placed.size();
    }
    CHECK(placed > 20);
    CHECK(left > 0);
}

TEST_CASE("pack: the same on any number of threads, and in every run") {
    test::random source(2);
    const std::vector<tf::mesh> parts = mixed_parts(source, 6);
    const tf::pack_options options{.size = {45, 45, any_height}, .turns = plate_turns::any};
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
    refused({.size = {10, any_height, 10}});
    refused({.size = {10, 10, nan}});
    refused({.size = {10, 10, 10}, .corner = {nan, 0, 0}});
    refused({.size = {10, 10, 10}, .spacing = -1});
    refused({.size = {10, 10, 10}, .spacing = nan});
    refused({.size = {10, 10, 10}, .attempts = 0});
    parts[1].points[3].x = nan;
    CHECK_THROWS_WITH_AS(static_cast<void>(tf::pack(views(parts), {.size = {10, 10, 10}})),
                         doctest::Contains("part 1"), std::invalid_argument);
    parts[1] = test::box(1e308, 1e308, 1e308);
    parts[2] = test::box(1e-308, 1e-308, 1e-308);
    const auto found = tf::pack(views(parts), {.size = {10, 10, 10}});
    CHECK(found.not_placed == std::vector<std::uint32_t>{1});
}
