/// \file
/// Both rules, by every search, against all pairs of clouds of twenty thousand points.
///
/// Points a cloud: 20000, or 10 times $TREEFORM_STRESS_COUNT.

#include <libmesh/weld/group_points.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/brute_weld.hpp>
#include <support/random.hpp>
#include <support/settings.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace {

using tf::point3;
using tf::detail::weld::neighbor_search;
using cloud = std::vector<point3>;

constexpr std::array searches{neighbor_search::automatic, neighbor_search::window,
                              neighbor_search::cells, neighbor_search::tree};

std::size_t points_a_cloud() { return 10 * test::setting("TREEFORM_STRESS_COUNT", 2000); }

std::vector<std::uint32_t> leaders(const cloud& points, const tf::weld_options& options,
                                   neighbor_search search) {
    const tf::point_groups groups =
        tf::detail::weld::find_groups("group_points", points, options, search);
    std::vector<std::uint32_t> leader;
    for (const std::uint32_t g : groups.group_of_point) leader.push_back(groups.first_of_group[g]);
    return leader;
}

void check(const std::function<point3(std::size_t)>& make, std::vector<double> tolerances) {
    cloud points;
    for (std::size_t i = 0; i < points_a_cloud(); ++i) points.push_back(make(i));
    for (const double tolerance : tolerances) {
        CAPTURE(tolerance);
        const auto linked = [&](std::uint32_t i, std::uint32_t j) {
            return tf::test::brute_within(points[i], points[j], tolerance);
        };
        const auto first = tf::test::brute_leaders(points, linked);
        const auto chain = tf::test::brute_chains(points, linked);
        for (const neighbor_search search : searches) {
            CAPTURE(static_cast<int>(search));
            CHECK(leaders(points, {.tolerance = tolerance}, search) == first);
            CHECK(leaders(points, {.tolerance = tolerance, .chain = true}, search) == chain);
        }
    }
}

}  // namespace

TEST_CASE("group_points: twenty thousand random points give what all pairs give") {
    test::random random(1);
    check(
        [&](std::size_t) {
            return point3{random.unit(), random.unit(), random.unit()};
        },
        {0.005, 0.02, 0.03});
}

TEST_CASE("group_points: twenty thousand points of a grid give what all pairs give") {
    test::random random(2);
    const auto step = [&] { return 0.1 * static_cast<double>(random.below(32)); };
    check(
        [&](std::size_t) {
            return point3{step(), step(), step()};
        },
        {0.0, 0.1, 0.1 * std::sqrt(2.0)});
}

TEST_CASE("group_points: twenty thousand points in clusters give what all pairs give") {
    test::random random(3);
    cloud middles;
    for (int i = 0; i < 50; ++i) middles.push_back({random.unit(), random.unit(), random.unit()});
    check(
        [&](std::size_t) {
            const point3& m = middles[random.below(middles.size())];
            const double size = 0.02 * random.unit();
            return point3{m.x + size * random.unit(), m.y + size * random.unit(),
                          m.z + size * random.unit()};
        },
        {0.0005, 0.003, 0.05});
}

TEST_CASE("group_points: twenty thousand points in heaps of equal ones give what all pairs give") {
    test::random random(4);
    cloud places;
    for (int i = 0; i < 300; ++i) places.push_back({random.unit(), random.unit(), random.unit()});
    check([&](std::size_t) { return places[random.below(places.size())]; }, {0.0, 0.02, 0.1});
}

TEST_CASE("group_points: twenty thousand points along a thread give what all pairs give") {
    test::random random(5);
    const std::size_t count = points_a_cloud();
    check(
        [&](std::size_t) {
            const double turn = 0.01 * static_cast<double>(random.below(count));
            return point3{std::cos(turn), std::sin(turn), 0.01 * turn};
        },
        {0.005, 0.0101, 0.02});
}
