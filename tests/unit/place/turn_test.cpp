#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/time_of_impact.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>
#include <support/tubes.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

using std::numbers::pi;

constexpr tf::point3 up{0, 0, 1};

tf::mesh turned_by(const tf::mesh& mesh, const tf::transform<3>& by) {
    tf::mesh there = mesh;
    for (tf::point3& p : there.points) p = by(p);
    return there;
}

/// About a line through the origin along z.
tf::transform<3> about_z(double angle) {
    tf::transform<3> m;
    m.rows[0] = {std::cos(angle), -std::sin(angle), 0, 0};
    m.rows[1] = {std::sin(angle), std::cos(angle), 0, 0};
    return m;
}

/// What the header says of a place.
void check_turn(const tf::mesh& moving, const tf::mesh& fixed, const tf::placement& found,
                const tf::placement_options& options = {}) {
    REQUIRE(found);
    REQUIRE(found.points.size() == moving.points.size());
    const tf::mesh there{found.points, moving.faces};
    CHECK(tf::relation(there, fixed).relation != tf::mesh_relation::penetrating);
    const double gap = tf::distance(there, fixed);
    CAPTURE(found.statistics.steps);
    CAPTURE(found.statistics.backed_off);
    CAPTURE(found.nearest->distance);
    CAPTURE(found.contacts.size());
    CHECK(gap >= options.clearance);
    double largest = 0.0;
    for (const tf::mesh* m : {&moving, &fixed, &there})
        for (const tf::point3& p : m->points)
            for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, std::abs(p[k]));
    const bool single = options.precision == tf::precision::float32;
    const double unit = largest * (single ? 0x1p-21 : 0x1p-44);
    CHECK(gap <= options.clearance + found.tolerance + unit);
    for (std::size_t i = 0; i < moving.points.size(); ++i) {
        const tf::point3 q = found.matrix(moving.points[i]);
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(std::abs(q[k] - found.points[i][k]) <= unit);
            if (single) CHECK(found.points[i][k] == double{static_cast<float>(found.points[i][k])});
        }
    }
    CHECK(found.outcome == tf::placement_outcome::contact);
    CHECK_FALSE(found.contacts.empty());
}

}  // namespace

TEST_CASE("turn: a door stops at the wall, at the angle that it is known to") {
    const tf::mesh door = test::box(10, 1, 3);
    const tf::mesh wall = test::moved(test::box(40, 1, 1), {-20, 5, 1});
    const double radius = std::sqrt(101.0), begin = std::atan2(1.0, 10.0);
    for (const double clearance : {0.0, 0.25})
        for (const auto precision : {tf::precision::float64, tf::precision::float32}) {
            const tf::placement_options options{.clearance = clearance, .precision = precision};
            const auto found = tf::turn(door, wall, {}, up, options);
            check_turn(door, wall, found, options);
            const double angle = (std::asin((5 - clearance) / radius) - begin) * 180 / pi;
            const double unit = precision == tf::precision::float32 ? 1e-4 : 1e-7;
            CHECK(found.angle <= angle + unit);
            CHECK(found.angle >= angle - unit);
            CHECK(found.statistics.steps < 100);
        }
    // The other way round it comes to the wall's other end.
    const auto back = tf::turn(door, wall, {}, {0, 0, -3});
    check_turn(door, wall, back);
}

TEST_CASE("turn: what is free all around meets nothing, also in a bore that it nearly fills") {
    const tf::mesh shaft = test::tube(10, 8, 20, 48);
    const tf::mesh bore = test::moved(test::tube(20, 10 + 0.05, 10, 96), {0, 0, 5});
    const auto found = tf::turn(shaft, bore, {}, up);
    CHECK_FALSE(found);
    CHECK(found.outcome == tf::placement_outcome::nothing_met);
    CHECK(found.statistics.steps < 5000);
    const auto nothing = tf::turn(shaft, test::moved(bore, {100, 0, 0}), {}, up);
    CHECK(nothing.outcome == tf::placement_outcome::nothing_met);
    CHECK(nothing.statistics.fixed_culled == 1);
    // A hexagonal shaft in a hexagonal bore gets stuck.
    const tf::mesh nut = test::tube(20, 11, 10, 6),
                   screw = test::moved(test::tube(10.5, 5, 10, 6), {0, 0, 0.5});
    const auto stuck = tf::turn(screw, nut, {}, up);
    check_turn(screw, nut, stuck);
    CHECK(stuck.angle > 1.0);
    CHECK(stuck.angle < 30.0);
    // where a corner of the screw is on a side of the nut
    const double angle = 30 - std::acos(11 * std::cos(pi / 6) / 10.5) * 180 / pi;
    CHECK(stuck.angle == doctest::Approx(angle).epsilon(1e-7));
    tf::placement_options few{.max_steps = 3};
    CHECK(tf::turn(shaft, bore, {}, up, few).outcome == tf::placement_outcome::too_many_steps);
    few = {.max_angle = 0.5 * angle};
    CHECK(tf::turn(screw, nut, {}, up, few).outcome == tf::placement_outcome::nothing_met);
}

TEST_CASE("turn: on the way nothing is met, and a little further something is") {
    test::random source(3);
    int met = 0, free = 0, beyond = 0;
    for (int round = 0; round < 40; ++round) {
        CAPTURE(round);
        const tf::mesh a = test::moved(
            round % 2 == 0 ? test::ball(1, source.in(0.5, 2.0)) : test::box(source.in(1, 3), 1, 2),
            {source.in(2, 5), source.in(-1, 1), source.in(-1, 1)});
        tf::mesh b = test::moved(test::box(source.in(1, 3), source.in(1, 3), source.in(1, 3)),
                                 {source.in(-7, -2), source.in(-4, 4), source.in(-2, 1)});
        if (tf::relation(a, b).relation != tf::mesh_relation::disjoint) continue;
        const tf::placement_options options{.clearance = round % 3 == 0 ? 0.1 : 0.0};
        if (tf::distance(a, b) <= options.clearance) continue;
        const auto found = tf::turn(a, b, {}, up, options);
        const double last = found ? found.angle * pi / 180 : 2 * pi;
        if (found) check_turn(a, b, found, options);
        ++(found ? met : free);
        for (int i = 0; i < 60; ++i) {
            const tf::mesh there = turned_by(a, about_z(last * i / 60));
            CHECK(tf::distance(there, b) >= options.clearance);
            CHECK(tf::relation(there, b).relation == tf::mesh_relation::disjoint);
        }
        if (!found) continue;
        const tf::mesh there = turned_by(a, about_z(last + 1e-4));
        beyond += tf::distance(there, b) <= options.clearance ||
                  tf::relation(there, b).relation != tf::mesh_relation::disjoint;
    }
    CHECK(met > 10);
    CHECK(free > 3);
    CHECK(beyond >= met - 1);
}

TEST_CASE("turn: about any line, with others about, the same on any number of threads") {
    test::random source(4);
    const tf::mesh arm = test::moved(test::box(8, 1, 1), {101, 50, 20});
    std::vector<tf::prepared_mesh> fixed;
    for (int i = 0; i < 6; ++i)
        fixed.emplace_back(
            test::moved(test::ball(2, 0.7),
                        {100 + source.in(-9, 9), 50 + source.in(2, 9), 20 + source.in(-4, 4)}));
    const tf::prepared_mesh moving(tf::mesh{arm});
    const tf::point3 origin{100, 50, 20}, direction{0.3, -0.2, 1.0};
    const auto one = tf::turn(moving, fixed, origin, direction);
    CHECK(one.points.size() == arm.points.size());
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        const auto other = tf::turn(moving, fixed, origin, direction);
        CHECK(other.points == one.points);
        CHECK(other.angle == one.angle);
        CHECK(other.statistics.steps == one.statistics.steps);
    }
}

TEST_CASE("turn: what touches at the start stays, what penetrates has no place") {
    const tf::mesh box = test::box(1, 1, 1);
    const auto touching = tf::turn(box, test::moved(box, {1, 0, 0}), {}, up);
    REQUIRE(touching);
    CHECK(touching.outcome == tf::placement_outcome::unchanged);
    CHECK(touching.points == box.points);
    CHECK(touching.angle == 0.0);
    CHECK(tf::turn(box, test::moved(box, {1, 0, 0}), {}, up, {.clearance = 1}).outcome ==
          tf::placement_outcome::starts_touching);
    CHECK(tf::turn(box, test::moved(box, {0.5, 0, 0}), {}, up).outcome ==
          tf::placement_outcome::starts_penetrating);
    CHECK(tf::turn(box, test::moved(box, {1.5, 0, 0}), {}, up, {.clearance = 1}).outcome ==
          tf::placement_outcome::starts_too_near);
    CHECK(tf::turn(box, tf::mesh{}, {}, up).outcome == tf::placement_outcome::nothing_met);
    CHECK(tf::turn(tf::mesh{}, box, {}, up).outcome == tf::placement_outcome::nothing_met);
    CHECK(tf::turn(box, test::moved(box, {3, 0, 0}), {}, up,
                   {.progress = [](double) { return false; }})
              .outcome == tf::placement_outcome::cancelled);
}

TEST_CASE("turn: what cannot be meant is refused") {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const tf::mesh box = test::box(1, 1, 1), other = test::moved(box, {3, 0, 0});
    const auto refused = [&](const tf::point3& origin, const tf::point3& direction,
                             const tf::placement_options& o = {}) {
        CHECK_THROWS_AS(static_cast<void>(tf::turn(box, other, origin, direction, o)),
                        std::invalid_argument);
    };
    refused({}, {0, 0, 0});
    refused({}, {0, nan, 1});
    refused({nan, 0, 0}, up);
    refused({}, up, {.clearance = -1});
    refused({}, up, {.max_angle = 0});
    refused({}, up, {.max_angle = 361});
    refused({}, up, {.tolerance = 0.0});
}
