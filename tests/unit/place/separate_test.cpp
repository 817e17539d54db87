#include <libmesh/place/separation_search.hpp>
#include <libmesh/place/snap_to_representable.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace {

using test::box;
using test::moved;
using tf::mesh_relation;
using tf::prepared_mesh;
using tf::detail::place::search_separations;
using tf::detail::place::separation;
using tf::detail::place::shape;
using tf::detail::place::snap_to_representable;
using tf::detail::place::snapped;

std::vector<separation> moves(const tf::mesh& a, const tf::mesh& b, double clearance = 0.0) {
    const auto one = prepared_mesh::borrow(a), other = prepared_mesh::borrow(b);
    const shape part(other);
    return search_separations(shape(one), {&part, 1}, {.clearance = clearance}).moves;
}

snapped settled(const tf::mesh& a, const tf::mesh& b, const separation& move,
                double clearance = 0.0) {
    const auto other = prepared_mesh::borrow(b);
    const shape part(other);
    return snap_to_representable(prepared_mesh::borrow(a), {&part, 1}, move.direction, move.time,
                                 {.clearance = clearance, .forward = true});
}

}  // namespace

TEST_CASE("separate: where nothing is too near, nothing moves") {
    const tf::mesh b = box(4, 4, 4);
    CHECK(moves(moved(box(1, 1, 1), {9, 0, 0}), b).empty());
    CHECK(moves(moved(box(1, 1, 1), {4, 0, 0}), b).empty());  // touching
    CHECK(moves(moved(box(1, 1, 1), {5, 0, 0}), b, 1.0).empty());
    CHECK(moves({}, b).empty());
    CHECK(moves(b, {}).empty());
}

TEST_CASE("separate: what rounding would push into its neighbor moves away by a step") {
    for (const double x : {0.1, 1.0 / 3.0, 0.7, 1234.56789})
        for (const double clearance : {0.0, 0.01}) {
            const tf::mesh a = tf::box3{{x - 1.0, 0, 0}, {x, 1, 1}}.mesh();
            const tf::mesh b = tf::box3{{x + clearance, 0, 0}, {x + 2.0, 1, 1}}.mesh();
            const tf::placement made =
                tf::separate(a, b, {.clearance = clearance, .precision = tf::precision::float32});
            CAPTURE(x);
            CAPTURE(clearance);
            REQUIRE(made);
            CHECK(made.travel <= 3.0 * tf::coordinate_step(a.points, tf::precision::float32));
            CHECK(made.relation != mesh_relation::penetrating);
            CHECK(tf::distance(tf::mesh{made.points, a.faces}, b) >= clearance);
        }
}

TEST_CASE("separate: a box leaves another by the shortest of its sides") {
    const tf::mesh b = box(4, 4, 4);
    for (std::size_t k = 0; k < 3; ++k)
        for (const double sign : {1.0, -1.0})
            for (const double clearance : {0.0, 0.5}) {
                tf::point3 at{1.5, 1.5, 1.5};
                at[k] = sign > 0 ? 3.75 : -0.75;
                const auto found = moves(moved(box(1, 1, 1), at), b, clearance);
                REQUIRE(!found.empty());
                CHECK(found[0].time == 0.25 + clearance);
                CHECK(found[0].direction[k] == sign);
            }
}

TEST_CASE("separate: a mesh wholly inside a solid comes out through the nearest wall") {
    const auto found = moves(moved(box(1, 1, 1), {5, 5, 0.5}), box(10, 10, 10));
    REQUIRE(!found.empty());
    CHECK(found[0].time == 1.5);
    CHECK(found[0].direction == tf::point3{0, 0, -1});
}

TEST_CASE("separate: in a corner a mesh moves away from all walls at once") {
    const tf::mesh corner = test::together(box(10, 10, 1), box(1, 10, 10));
    const tf::mesh a = moved(box(1, 1, 1), {1.25, 5, 1.25});
    const auto found = moves(a, corner, 0.5);
    REQUIRE(!found.empty());
    CHECK(found[0].time == doctest::Approx(std::sqrt(0.125)).epsilon(1e-6));
    const auto placed = settled(a, corner, found[0], 0.5);
    CHECK(placed.good);
}

TEST_CASE("separate: every move given leads to a place that settles nearby") {
    test::random source(4);
    for (int round = 0; round < 12; ++round) {
        const double clearance = round % 2 == 0 ? 0.0 : 0.1;
        const tf::mesh b = test::ball(2, 1.0);
        const tf::mesh a = moved(
            test::ball(2, 0.7), {source.in(-0.9, 0.9), source.in(-0.9, 0.9), source.in(-0.9, 0.9)});
        const auto found = moves(a, b, clearance);
        REQUIRE(!found.empty());
        for (std::size_t i = 0; i < found.size(); ++i) {
            if (i > 0) CHECK(found[i - 1].time <= found[i].time);
            const auto placed = settled(a, b, found[i], clearance);
            REQUIRE(placed.good);
            CHECK(placed.time - found[i].time < 1e-9);
            const tf::mesh there{placed.points, a.faces};
            CHECK(tf::relation(there, b).relation != mesh_relation::penetrating);
            CHECK(tf::closest_pair(there, b)->distance >= clearance);
        }
        // The balls lie within spheres, which the line of the centers takes apart.
        const tf::point3& tip = a.points[0];
        const double apart = std::hypot(tip.x - 0.7, tip.y, tip.z);
        CHECK(found[0].time <= 1.1 * (1.7 + clearance - apart));
    }
}

TEST_CASE("separate: the same on any number of threads") {
    const tf::mesh b = test::ball(3, 1.0);
    const tf::mesh a = moved(test::ball(3, 0.7), {0.5, 0.25, 0.75});
    const auto with = [&](unsigned threads) {
        const tf::thread_scope scope(threads);
        std::vector<double> numbers;
        for (const auto& move : moves(a, b, 0.05))
            numbers.insert(numbers.end(),
                           {move.direction.x, move.direction.y, move.direction.z, move.time});
        return numbers;
    };
    const auto one = with(1);
    CHECK(!one.empty());
    CHECK(one == with(2));
    CHECK(one == with(8));
}

TEST_CASE("separate: a clearance that cannot be meant is refused") {
    for (const double c : {-1.0, std::nan(""), 1.0 / 0.0})
        CHECK_THROWS_AS(static_cast<void>(moves(box(1, 1, 1), box(1, 1, 1), c)),
                        std::invalid_argument);
}

TEST_CASE("separate: the mesh comes out of all, in coordinates that hold") {
    test::random source(14);
    for (int round = 0; round < 10; ++round) {
        const double clearance = round % 2 == 0 ? 0.0 : 0.125;
        const bool single = round % 3 == 0;
        std::vector<prepared_mesh> fixed;
        for (const double x : {0.0, 1.5}) fixed.emplace_back(moved(test::ball(2, 1.0), {x, 0, 0}));
        const tf::mesh a = moved(test::ball(2, 0.5), {source.in(-1, 2), source.in(-1, 1), 0.25});
        const auto whole = prepared_mesh::borrow(a);
        const auto found =
            tf::separate(whole, fixed,
                         {.clearance = clearance,
                          .precision = single ? tf::precision::float32 : tf::precision::float64});
        REQUIRE(found);
        CHECK(found.relation != tf::mesh_relation::penetrating);
        CHECK(found.relation != tf::mesh_relation::closer_than_clearance);
        const tf::mesh there{found.points, a.faces};
        for (const prepared_mesh& one : fixed) {
            CHECK(tf::relation(there, one.indexed_view()).relation != mesh_relation::penetrating);
            CHECK(tf::closest_pair(there, one.indexed_view())->distance >= clearance);
        }
        if (found.travel == 0.0) continue;
        const auto barred =
            tf::separate(whole, fixed, {.clearance = clearance, .max_travel = 1e-9});
        CHECK(barred.outcome == tf::placement_outcome::too_far);
        CHECK(barred.points == a.points);
    }
}
