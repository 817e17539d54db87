#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>
#include <support/still_parts.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

using test::box;
using test::moved;
using test::still_parts;
using tf::placement_outcome;
using tf::prepared_mesh;

}  // namespace

TEST_CASE("mate: a corner comes to a corner, or to the clearance from it") {
    still_parts among;
    among.add(moved(box(1, 1, 1), {90, 0, 0}));
    among.add(box(4, 4, 1));
    const prepared_mesh a(moved(box(1, 1, 1), {7, 8, 1}));
    const auto found = tf::mate(a, among.prepared);
    REQUIRE(found);
    CHECK(found.outcome == placement_outcome::contact);
    CHECK(found.relation_at_start == tf::mesh_relation::disjoint);
    CHECK(found.relation == tf::mesh_relation::touching);
    REQUIRE(found.nearest);
    CHECK(found.nearest_fixed == 1);
    CHECK(found.travel == 5.0);
    CHECK(found.direction == tf::point3{-0.6, -0.8, 0});
    CHECK(found.points == moved(box(1, 1, 1), {4, 4, 1}).points);
    CHECK(found.contact_count > 0);
    CHECK(among.prepared[0].indexes_built() == 0);  // far away
    const auto apart = tf::mate(a, among.prepared, {.clearance = 1.25});
    REQUIRE(apart);
    CHECK(apart.travel == doctest::Approx(3.75).epsilon(1e-12));
    CHECK(apart.relation == tf::mesh_relation::clear);
    CHECK(tf::mate(a, among.prepared, {.clearance = 6}).outcome ==
          placement_outcome::starts_too_near);
    CHECK(tf::mate(a, among.prepared, {.max_travel = 4.5}).outcome == placement_outcome::too_far);
    CHECK(tf::mate(a.indexed_view(), among.meshes[1]).points == found.points);
}

TEST_CASE("mate: of nothing there is no way, and what meets stays") {
    still_parts among;
    const prepared_mesh a(box(1, 1, 1));
    CHECK(tf::mate(a, among.prepared).outcome == placement_outcome::nothing_met);
    among.add({});
    CHECK(tf::mate(a, among.prepared).outcome == placement_outcome::nothing_met);
    among.add(moved(box(1, 1, 1), {1, 0, 0}));
    const auto touching = tf::mate(a, among.prepared);
    REQUIRE(touching);
    CHECK(touching.outcome == placement_outcome::unchanged);
    CHECK(touching.nearest_fixed == 1);
    CHECK(touching.relation == tf::mesh_relation::touching);
    CHECK(touching.travel == 0.0);
    CHECK(tf::mate(a, among.prepared, {.clearance = 1}).outcome ==
          placement_outcome::starts_touching);
    among.add(moved(box(1, 1, 1), {0.5, 0, 0}));
    const auto inside = tf::mate(a, among.prepared);
    CHECK(inside.nearest_fixed == 2);
    CHECK(inside.outcome == placement_outcome::starts_penetrating);
    CHECK(inside.certificate.status == tf::status::no_placement);
    CHECK(tf::mate(prepared_mesh(), among.prepared).outcome == placement_outcome::nothing_met);
    for (const double clearance : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()})
        CHECK_THROWS_AS(static_cast<void>(tf::mate(a, among.prepared, {.clearance = clearance})),
                        std::invalid_argument);
}

TEST_CASE("mate: the place is at the part that is nearest of all, and penetrates none") {
    test::random source(3);
    for (int round = 0; round < 20; ++round) {
        still_parts among;
        for (int i = 0; i < 5; ++i)
            among.add(moved(test::ball(1, 0.3 + 0.3 * source.unit()),
                            {source.in(-4, 4), source.in(-4, 4), source.in(-4, 4)}));
        const tf::mesh a = moved(test::ball(1, 0.4), {source.in(-3, 3), source.in(-3, 3), 6.0});
        double least = std::numeric_limits<double>::infinity();
        for (const tf::mesh& part : among.meshes)
            least = std::min(least, tf::closest_pair(a, part)->distance);
        const auto found = tf::mate(prepared_mesh::borrow(a), among.prepared);
        REQUIRE(found);
        CHECK(found.travel == doctest::Approx(least).epsilon(1e-12));
        double there = std::numeric_limits<double>::infinity();
        for (const tf::mesh& part : among.meshes) {
            const tf::mesh at{found.points, a.faces};
            CHECK(tf::relation(at, part).relation != tf::mesh_relation::penetrating);
            there = std::min(there, tf::closest_pair(at, part)->distance);
        }
        CHECK(there < 1e-14);
    }
}

TEST_CASE("mate: progress goes from 0 to 1, a stop is heard, threads change nothing") {
    still_parts among;
    among.add(test::ball(3, 1.0));
    among.add(moved(test::ball(3, 1.0), {5, 0, 0}));
    const prepared_mesh a(moved(test::ball(3, 0.5), {2.25, 0.25, 3.0}));
    std::vector<double> shares;
    const auto found = tf::mate(a, among.prepared, {.progress = [&](double done) {
                                    shares.push_back(done);
                                    return true;
                                }});
    CHECK(found.certificate.status == tf::status::ok);
    CHECK(std::is_sorted(shares.begin(), shares.end()));
    CHECK(shares.back() == 1.0);
    for (const std::size_t stop_at : {std::size_t{1}, shares.size() / 2}) {
        std::size_t heard = 0;
        CHECK(tf::mate(a, among.prepared, {.progress = [&](double) { return ++heard < stop_at; }})
                  .certificate.status == tf::status::cancelled);
        CHECK(heard == stop_at);
    }
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        const auto same = tf::mate(a, among.prepared);
        CHECK(same.points == found.points);
        CHECK(same.matrix == found.matrix);
    }
}
