#include <libmesh/weld/group_points.hpp>
#include <libmesh/weld/near_cells.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace {

using tf::point3;
using tf::detail::weld::dense_leaders;
using tf::detail::weld::tiled_leaders;
using tf::detail::weld::tiling;
using cloud = std::vector<point3>;

constexpr std::size_t side = 640;
constexpr double largest = std::numeric_limits<double>::max();

/// One point near each place of a square grid, row by row.
cloud rows(test::random& random) {
    cloud points;
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x)
            points.push_back({static_cast<double>(x) + random.unit(),
                              static_cast<double>(y) + random.unit(), 0.1 * random.unit()});
    return points;
}

void check_groups(const cloud& points, const tf::weld_options& options) {
    const auto leaders = dense_leaders(points, options);
    const tf::point_groups groups = tf::group_points(points, options);
    REQUIRE(groups.group_of_point.size() == leaders.size());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < leaders.size(); ++i)
        if (groups.first_of_group[groups.group_of_point[i]] != leaders[i]) ++wrong;
    CHECK(wrong == 0);
}

/// Tiles would do, but are given up; the groups are the same.
void check_given_up(const cloud& points, double tolerance) {
    const tf::weld_options options{.tolerance = tolerance};
    CHECK(tiled_leaders(points, options).empty());
    CHECK(tiled_leaders(points, options, {.when = tiling::always}) ==
          dense_leaders(points, options));
    check_groups(points, options);
}

}  // namespace

TEST_CASE("tiled_leaders: rows that hang on each other are left to the way through the file") {
    test::random random(5);
    check_given_up(rows(random), 2.0);
}

TEST_CASE("tiled_leaders: the same points in any order are welded in tiles") {
    test::random random(6);
    cloud points = rows(random);
    random.shuffle(points);
    const tf::weld_options options{.tolerance = 1.25};
    CHECK(tiled_leaders(points, options) == dense_leaders(points, options));
    check_groups(points, options);
}

TEST_CASE("tiled_leaders: where few points are kept, they are not worth it") {
    test::random random(7);
    cloud points = rows(random);
    random.shuffle(points);
    check_given_up(points, 8.0);
}

TEST_CASE("tiled_leaders: where cubes give way to neighboring doubles, nothing is missed") {
    for (int sixteenths = 16; sixteenths < 32; ++sixteenths) {
        const double edge = sixteenths / 16.0;
        CHECK(std::nextafter(edge * 0x1p44, 0.0) * (1.0 / edge) < 0x1p44);
    }
    test::random random(8);
    for (int bits = 42; bits < 51; ++bits)
        for (const double edge : {1.1875, 1.875, 2.75}) {
            const double tolerance = edge / 2.09;
            CAPTURE(bits);
            cloud points;
            for (int i = 0; i < 2'000; ++i)
                points.push_back({std::ldexp(edge, bits) + random.in(-9, 9),
                                  random.in(-9, 9) - std::ldexp(1.0, bits), random.in(-2, 2)});
            const tf::weld_options options{.tolerance = tolerance};
            const auto expected = dense_leaders(points, options);
            CHECK(tiled_leaders(points, options, {4'000, tiling::always}) == expected);
            const auto in_tiles = tiled_leaders(points, options, {300, tiling::always});
            CHECK((in_tiles.empty() || in_tiles == expected));
        }
}

TEST_CASE("near_cells: an interval meets the first and the last of its cubes only") {
    test::random random(9);
    for (const double reach : {1.0, 1.26, 0.7, 0x1p-1060, 0x1p970}) {
        tf::detail::weld::cube_map cubes(reach);
        while (cubes.can_shrink()) cubes.shrink();
        for (int bits = 38; bits < 62; ++bits)
            for (int i = 0; i < 2'000; ++i) {
                const double at = std::min(std::ldexp(reach, bits) * random.in(0.9, 2.3), largest);
                const double sign = i % 2 == 0 ? 1.0 : -1.0;
                const double other =
                    std::clamp(at + reach * random.in(-1.0, 1.0), -largest, largest);
                if (!(std::abs(other - at) <= reach)) continue;
                const auto ends = cubes.around({sign * at, 0, 0});
                const auto cube = cubes.of({sign * other, 0, 0});
                const bool met = cube[0] == ends[0][0] || cube[0] == ends[1][0];
                if (!met) FAIL_CHECK(reach << " at " << at << ": " << other << " is not met");
            }
    }
}

TEST_CASE("near_places: what is within reach is never missed, what is far seldom taken for near") {
    test::random random(11);
    for (const double reach : {0.0, 0x1p-890, 0x1p-30, 1.0, 0x1p960}) {
        CAPTURE(reach);
        const double size = reach > 0.0 ? 1000.0 * reach : 1.0;
        const auto somewhere = [&] {
            return point3{random.in(0, size), random.in(0, size), random.in(0, size)};
        };
        tf::detail::weld::near_places places(reach, 1'000);
        CHECK_FALSE(places.may_have(somewhere()));
        cloud points;
        for (int i = 0; i < 1'000; ++i) places.add(points.emplace_back(somewhere()));
        for (const point3& p : points) {
            const double part = 0.57 * reach;  // along each axis: below 0.99 in all
            CHECK(places.may_have({p.x + part * random.in(-1, 1), p.y + part * random.in(-1, 1),
                                   p.z + part * random.in(-1, 1)}));
        }
        int taken = 0;
        for (int i = 0; i < 1'000; ++i) taken += places.may_have(somewhere()) ? 1 : 0;
        CHECK(taken < 300);
    }
}

TEST_CASE("tiled_leaders: next to the largest double nothing is missed") {
    const cloud points{{0, 0, 0x1.ffffffffffd53p+1023}, {0, 0, 0x1.ffffffffffea9p+1023}};
    const tf::weld_options options{.tolerance = 0x1.cp+979};
    CHECK(dense_leaders(points, options) == std::vector<std::uint32_t>{0, 0});
    CHECK(tiled_leaders(points, options, {10, tiling::always}) == dense_leaders(points, options));
}

TEST_CASE("tiled_leaders: distances whose squares overflow lead to the nearest, too") {
    test::random random(10);
    cloud points;
    for (int y = 0; y < 90; ++y)
        for (int x = 0; x < 90; ++x)
            points.push_back({0x1p520 * (x + random.unit()), 0x1p520 * (y + random.unit()), 0});
    for (int turn = 0; turn < 4; ++turn) {
        random.shuffle(points);
        const tf::weld_options options{.tolerance = 0x1.4p520};
        const auto tiled = tiled_leaders(points, options, {800, tiling::always});
        CHECK(tiled == dense_leaders(points, options));
    }
}

TEST_CASE("tiled_leaders: where a double is as wide as the tolerance, crowds take no time") {
    test::random random(11);
    cloud points;
    for (int i = 0; i < 50'000; ++i)
        points.push_back({0x1p52 + random.in(0, 1000), 0x1p52 + random.in(0, 1000),
                          0x1p52 + random.in(0, 1000)});
    const tf::weld_options options{.tolerance = 0.9};  // 10 s where cubes are 1024 doubles wide
    CHECK(tiled_leaders(points, options, {100'000, tiling::always}) ==
          dense_leaders(points, options));
}
