#include <libmesh/base/max_displacement.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/extremes.hpp>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

using test::infinity;

using points = std::vector<tf::point3>;

}  // namespace

TEST_CASE("step: it is the distance to the next number at the largest coordinate") {
    for (const double x : {1.0, 1.5, 2.0, -3.0, 1e6, 1e-300, 0x1p1000}) {
        const points one{{0, x, 0}};
        CHECK(tf::coordinate_step(one, tf::precision::float64) ==
              std::nextafter(std::abs(x), infinity) - std::abs(x));
    }
    for (const float x : {1.0F, 3.0F, 1e6F, 1e-40F})
        CHECK(tf::coordinate_step(points{{1e-50, -1e-50, x}}, tf::precision::float32) ==
              static_cast<double>(std::nextafter(x, 1e30F)) - static_cast<double>(x));
    CHECK(tf::coordinate_step({}, tf::precision::float32) == 0x1p-149);
    CHECK(tf::coordinate_step(points{{infinity, std::nan(""), 1}}, tf::precision::float64) ==
          0x1p-52);
}

TEST_CASE("in single: every coordinate is the nearest float, infinite beyond their range") {
    const points rounded =
        tf::rounded(points{{0.1, 1e300, -1e-300}, {1, -2, 16777217.0}}, tf::precision::float32);
    CHECK(rounded[0].x == static_cast<double>(0.1F));
    CHECK(rounded[0].y == infinity);
    CHECK(rounded[0].z == 0.0);
    CHECK(rounded[1] == tf::point3{1, -2, 16777216.0});
    CHECK(tf::rounded({}, tf::precision::float32).empty());
}

TEST_CASE("largest move: it sees what the doubles of the place itself lose") {
    const points one{{0.1, 1, 2}, {0.2, 1, 2}};
    CHECK(tf::detail::max_displacement(one, {}, one) == 0.0);
    const auto far = tf::transform<3>::translation(tf::point3{0x1p60, 0, 0});
    points there;
    for (const tf::point3& p : one) there.push_back(far(p));
    CHECK(there[0] == there[1]);
    CHECK(tf::detail::max_displacement(one, far, there) == 0.2);
    there[1].z = 3;
    CHECK(tf::detail::max_displacement(one, far, there) == 1.0);
    there[1].y = infinity;
    CHECK(tf::detail::max_displacement(one, far, there) == infinity);
    const auto huge = tf::transform<3>::translation(tf::point3{1e300, 0, 0});
    CHECK(tf::detail::max_displacement(points{{1e300, 0, 0}}, huge, points{{2e300, 0, 0}}) == 0.0);
    CHECK(tf::detail::max_displacement({}, {}, {}) == 0.0);
}

TEST_CASE("harm: floats far from the origin make faces of a fine mesh collapse and meet") {
    const tf::mesh ball = test::ball(4, 1.0);
    const auto harm = [&](double away) {
        const tf::mesh there = test::moved(ball, {away, away / 3, 0});
        return tf::find_rounding_defects(there, tf::rounded(there.points, tf::precision::float32));
    };
    CHECK(harm(0.0).collapsed == 0);
    CHECK(harm(0.0).meeting == 0);
    CHECK(harm(1e7).collapsed > 0);
    CHECK(harm(1e7).meeting > 0);
    tf::mesh flat = ball;
    for (tf::point3& p : flat.points) p.z = 0.0;
    CHECK(tf::find_rounding_defects(ball, flat.points).meeting > 0);
    for (tf::point3& p : flat.points) p.y = 0.0;
    CHECK(tf::find_rounding_defects(ball, flat.points).collapsed == ball.faces.size());
}

TEST_CASE("harm: what met and what was flat before is not counted") {
    test::random source(5);
    const tf::mesh soup = test::lattice_soup(source, 60, 30, 5);
    const auto same = tf::find_rounding_defects(soup, soup.points);
    CHECK(same.collapsed == 0);
    CHECK(same.meeting == 0);
    const auto turned = tf::find_rounding_defects(soup, test::scaled(soup, -2.0).points);
    CHECK(turned.collapsed == 0);
    CHECK(turned.meeting == 0);
    // Two boxes beside each other that cross once they are nearer, one of them with a flat face.
    tf::mesh two = test::together(test::box(1, 1, 1), test::moved(test::box(1, 1, 1), {3, 0.5, 0}));
    two.faces.push_back({0, 0, 1});
    points nearer = two.points;
    for (std::size_t i = 8; i < 16; ++i) nearer[i].x -= 2.5;
    const auto found = tf::find_rounding_defects(two, nearer);
    CHECK(found.collapsed == 0);
    CHECK(found.meeting > 0);
    CHECK(tf::find_rounding_defects({nearer, two.faces}, two.points).meeting == 0);
}

TEST_CASE("harm: nothing, a stop, bad input, and any number of threads") {
    const tf::mesh none;
    CHECK(tf::find_rounding_defects(none, {}).meeting == 0);
    const tf::mesh ball = test::ball(4, 1.0);
    const auto far = tf::rounded(test::moved(ball, {1e7, 3e6, 0}).points, tf::precision::float32);
    CHECK(tf::find_rounding_defects(ball, far, [](double) { return false; }).status ==
          tf::status::cancelled);
    CHECK_THROWS_AS(static_cast<void>(tf::find_rounding_defects(ball, {})), std::invalid_argument);
    points broken = ball.points;
    broken[3].x = std::nan("");
    CHECK_THROWS_AS(static_cast<void>(tf::find_rounding_defects(ball, broken)),
                    std::invalid_argument);
    std::vector<std::uint64_t> counts;
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        const auto found = tf::find_rounding_defects(ball, far);
        counts.push_back(found.meeting);
        counts.push_back(found.collapsed);
    }
    CHECK(counts == std::vector{counts[0], counts[1], counts[0], counts[1], counts[0], counts[1]});
}
