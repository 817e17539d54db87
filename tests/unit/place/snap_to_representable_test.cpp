#include <libmesh/place/snap_to_representable.hpp>
#include <libmesh/place/sweep_among.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/time_of_impact.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>
#include <support/still_parts.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

using test::box;
using test::moved;
using test::still_parts;
using tf::mesh_relation;
using tf::placement_outcome;
using tf::prepared_mesh;
using tf::detail::place::shape;
using tf::detail::place::snap_to_representable;
using tf::detail::place::sweep_among;

tf::impact approach(const tf::mesh& a, const tf::mesh& b, const tf::point3& motion, double distance,
                    const tf::impact_options& options = {}) {
    return tf::time_to_distance(a, b, motion, distance, options);
}

}  // namespace

TEST_CASE("time to distance: a box stops the clearance above another") {
    const tf::mesh floor = box(4, 4, 1);
    const tf::mesh a = moved(box(1, 1, 1), {1, 1, 5.5});
    const auto found = approach(a, floor, {0, 0, -1}, 0.5);
    CHECK(found.outcome == placement_outcome::contact);
    CHECK(found.time == 4.0);
    CHECK(found.contact_count > 0);
    for (const auto& c : found.contacts) CHECK(c.point.z == 1.0);
    CHECK(approach(a, floor, {0, 0, -2}, 0.5).time == 2.0);
    CHECK(approach(a, floor, {0, 0, 1}, 0.5).outcome == placement_outcome::nothing_met);
    CHECK(approach(a, floor, {0, 0, -1}, 0.5, {.latest = 3.5}).outcome ==
          placement_outcome::nothing_met);
    const auto up = tf::transform<3>::translation(tf::point3{0, 0, 1}),
               down = tf::transform<3>::translation(tf::point3{0, 0, -1});
    CHECK(approach(a, floor, {0, 0, -1}, 0.5, {.transform_a = up, .transform_b = down}).time ==
          found.time + 2);
    CHECK(approach(a, floor, {0, 0, -1}, 4.5).time == 0.0);
    CHECK(approach(a, floor, {0, 0, -1}, 5.0).outcome == placement_outcome::starts_touching);
}

TEST_CASE("time to distance: along a wall at just the distance a mesh goes on, a hair nearer not") {
    const tf::mesh wall = box(10, 1, 10);
    const tf::mesh stop = moved(box(1, 10, 10), {20, 0, 0});
    const tf::mesh a = moved(box(1, 1, 1), {-5, 1.5, 1});
    CHECK(approach(a, wall, {1, 0, 0}, 0.5).outcome == placement_outcome::nothing_met);
    const tf::mesh nearer = moved(box(1, 1, 1), {-5, 1.5 - 0x1p-30, 1});
    CHECK(approach(nearer, wall, {1, 0, 0}, 0.5).outcome == placement_outcome::contact);
    const auto end = approach(a, test::together(wall, stop), {1, 0, 0}, 0.5);
    CHECK(end.outcome == placement_outcome::contact);
    CHECK(end.time == 23.5);
}

TEST_CASE(
    "time to distance: before the time the meshes are apart by the distance, then no longer") {
    test::random source(21);
    int met = 0;
    for (int round = 0; round < 60; ++round) {
        const tf::mesh a = test::ball(1, 0.3 + source.unit());
        const tf::mesh b =
            moved(test::random_soup(source, 30, 0.3), {source.in(-1, 1), source.in(-1, 1), 6.0});
        const double distance = std::ldexp(source.unit(), -static_cast<int>(source.below(6)));
        const tf::point3 motion{source.in(-0.2, 0.2), source.in(-0.2, 0.2), source.in(0.5, 2)};
        const auto found = approach(a, b, motion, distance);
        const auto at = [&](double time) {
            return tf::closest_pair(moved(a, {time * motion.x, time * motion.y, time * motion.z}),
                                    b)
                ->distance;
        };
        const double end = found.outcome == placement_outcome::contact ? found.time : 20.0;
        for (int i = 0; i <= 20; ++i) CHECK(at(end * i / 20) >= distance - 1e-12);
        if (found.outcome != placement_outcome::contact) continue;
        ++met;
        CHECK(std::abs(at(found.time) - distance) < 1e-12);
        CHECK(at(found.time + 1e-4) < distance);
    }
    CHECK(met > 20);
}

TEST_CASE("sweep among: the first of several parts ends it, all that are met at once are named") {
    const tf::mesh a = moved(box(6, 1, 1), {0, 0, 9});
    still_parts among;
    among.add(box(1, 1, 2));
    among.add(moved(box(1, 1, 3), {2, 0, 0}));
    among.add(moved(box(1, 1, 3), {4, 0, 0}));
    among.add(moved(box(1, 1, 8), {7, 0, 0}));  // beside it
    const auto whole = prepared_mesh::borrow(a);
    const shape given(whole);
    for (const double clearance : {0.0, 0.25}) {
        const auto found = sweep_among(given, among.parts(), {0, 0, -1}, {.clearance = clearance});
        CHECK(found.outcome == placement_outcome::contact);
        CHECK(found.time == 6.0 - clearance);
        CHECK(found.part == 1);
        bool second = false;
        for (const auto& c : found.contacts) {
            CHECK((c.part == 1 || c.part == 2));
            second = second || c.part == 2;
            CHECK(c.where.point.z == 3.0);
        }
        if (clearance == 0.0) CHECK(second);
    }
    CHECK(sweep_among(given, among.parts(), {0, 0, -1}, {.latest = 5.0}).outcome ==
          placement_outcome::nothing_met);
    CHECK(sweep_among(given, {}, {0, 0, -1}).outcome == placement_outcome::nothing_met);
    among.add(moved(box(1, 1, 1), {3, 1, 9}));  // it touches this one
    const auto stuck = sweep_among(given, among.parts(), {0, 0, -1});
    CHECK(stuck.outcome == placement_outcome::starts_touching);
    CHECK(stuck.part == 4);
}

TEST_CASE("settle among: what is written neither penetrates nor is nearer than the clearance") {
    test::random source(8);
    std::size_t stepped_back = 0;
    for (int round = 0; round < 40; ++round) {
        const double far = round % 2 == 0 ? 0.0 : 1e3;
        still_parts among;
        for (int i = 0; i < 3; ++i)
            among.add(moved(test::ball(2, 0.3 + source.unit()),
                            {source.in(-1, 1) + far, source.in(-1, 1), source.in(-0.5, 0.5)}));
        const bool single = round % 4 < 2;
        const double clearance = round % 3 == 0 ? 0.125 : 0.0;
        const tf::mesh a = moved(test::ball(2, 0.5), {far, 0, 5});
        const tf::point3 down{source.in(-0.05, 0.05), 0, -1};
        const auto whole = prepared_mesh::borrow(a);
        const auto found = sweep_among(shape(whole), among.parts(), down, {.clearance = clearance});
        REQUIRE(found.outcome == placement_outcome::contact);
        const auto settled = snap_to_representable(
            whole, among.parts(), down, found.time,
            {.precision = single ? tf::precision::float32 : tf::precision::float64,
             .clearance = clearance});
        REQUIRE(settled.good);
        stepped_back += settled.backed_off > 0;
        CHECK(std::abs(settled.time - found.time) < 1e-2);
        const tf::mesh there{settled.points, a.faces};
        for (const tf::mesh& part : among.meshes) {
            CHECK(tf::relation(there, part).relation != mesh_relation::penetrating);
            CHECK(tf::closest_pair(there, part)->distance >= clearance);
        }
        for (const tf::point3& p : there.points)
            if (single) CHECK(p.z == double{static_cast<float>(p.z)});
    }
    CHECK(stepped_back > 0);
}

TEST_CASE("settle among: the lowest points come to lie on the floor exactly") {
    test::random source(2);
    for (int round = 0; round < 200; ++round) {
        const double floor = round % 3 == 0 ? 0.0 : source.in(-10, 10);
        const tf::mesh a = moved(test::ball(1, 1.0), {0, 0, source.in(10, 1000)});
        double lowest = std::numeric_limits<double>::infinity();
        for (const tf::point3& p : a.points) lowest = std::min(lowest, p.z);
        const bool single = round % 2 == 0 && floor == 0.0;
        const auto settled = snap_to_representable(
            prepared_mesh::borrow(a), {}, {0, 0, -1}, lowest - floor,
            {.precision = single ? tf::precision::float32 : tf::precision::float64,
             .floor = floor});
        CHECK(settled.good);
        double reached = std::numeric_limits<double>::infinity();
        for (const tf::point3& p : settled.points) reached = std::min(reached, p.z);
        CHECK(reached == floor);
    }
}

TEST_CASE("settle among: forward it backs off to later times") {
    still_parts among;
    among.add(box(1, 1, 1));
    const tf::mesh a = moved(box(1, 1, 1), {0.25, 0.25, 0.25});
    const auto out = snap_to_representable(prepared_mesh::borrow(a), among.parts(), {0, 0, 1},
                                           0.75 - 0x1p-52, {.forward = true});
    CHECK(out.good);
    CHECK(out.relation != mesh_relation::penetrating);
    CHECK(out.time >= 0.75);
    CHECK(out.time == doctest::Approx(0.75).epsilon(1e-15));
    CHECK(out.backed_off > 0);
}

TEST_CASE("settle among: what cannot be meant is refused") {
    const tf::mesh b = box(1, 1, 1);
    const auto one = prepared_mesh::borrow(b);
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double distance : {0.0, -1.0, infinity, std::nan("")})
        CHECK_THROWS_AS(static_cast<void>(approach(b, b, {0, 0, -1}, distance)),
                        std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(approach(moved(b, {0, 0, 3}), b, {0, 0, 0}, 1.0)),
                    std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(snap_to_representable(one, {}, {0, 0, 0}, 1.0)),
                    std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(snap_to_representable(one, {}, {0, 0, 1}, infinity)),
                    std::invalid_argument);
    CHECK_THROWS_AS(
        static_cast<void>(snap_to_representable(one, {}, {0, 0, 1}, 1.0, {.clearance = -1.0})),
        std::invalid_argument);
}
