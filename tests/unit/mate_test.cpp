#include <libmesh/base/face_tree.hpp>
#include <treeform/mesh/mate.hpp>
#include <treeform/mesh/mesh_distance.hpp>
#include <treeform/mesh/settle_among.hpp>
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
using tf::mesh_relation;

}  // namespace

TEST_CASE("mate: a corner comes to a corner, or to the clearance from it") {
    still_parts among;
    among.add(moved(box(1, 1, 1), {90, 0, 0}));
    among.add(box(4, 4, 1));
    const tf::mesh a = moved(box(1, 1, 1), {7, 8, 1});
    const tf::tree<3> tree = tf::face_tree(a);
    const auto found = tf::mate(a, tree, among.parts);
    REQUIRE(found.has_value());
    CHECK(found->part == 1);
    CHECK(found->nearest.distance == 5.0);
    CHECK(found->motion == tf::point3{-3, -4, 0});
    CHECK(found->time == 1.0);
    CHECK(found->met.end == tf::motion_end::contact);
    const auto apart = tf::mate(a, tree, among.parts, {.clearance = 1.25});
    REQUIRE(apart.has_value());
    CHECK(apart->time == doctest::Approx(0.75).epsilon(1e-12));
    CHECK(tf::mate(a, tree, among.parts, {.clearance = 6})->met.end == tf::motion_end::at_start);
}

TEST_CASE("mate: of nothing there is no way, and what meets stays") {
    still_parts among;
    const tf::mesh a = box(1, 1, 1);
    const tf::tree<3> tree = tf::face_tree(a);
    CHECK_FALSE(tf::mate(a, tree, among.parts).has_value());
    among.add({});
    CHECK_FALSE(tf::mate(a, tree, among.parts).has_value());
    among.add(moved(box(1, 1, 1), {1, 0, 0}));
    const auto touching = tf::mate(a, tree, among.parts);
    REQUIRE(touching.has_value());
    CHECK(touching->part == 1);
    CHECK(touching->nearest.relation.relation == mesh_relation::touching);
    CHECK(touching->time == 0.0);
    among.add(moved(box(1, 1, 1), {0.5, 0, 0}));
    CHECK(tf::mate(a, tree, among.parts)->part == 2);
    const tf::mesh none;
    CHECK_FALSE(tf::mate(none, tf::face_tree(none), among.parts).has_value());
    among.parts.resize(1);
    among.add(moved(box(1, 1, 1), {3, 0, 0}));
    for (const double clearance : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()})
        CHECK_THROWS_AS(
            static_cast<void>(tf::mate(a, tree, {&among.parts[1], 1}, {.clearance = clearance})),
            std::invalid_argument);
}

TEST_CASE("mate: the place settles at the part that is nearest of all, and penetrates none") {
    test::random source(3);
    for (int round = 0; round < 20; ++round) {
        still_parts among;
        for (int i = 0; i < 5; ++i)
            among.add(moved(test::ball(1, 0.3 + 0.3 * source.unit()),
                            {source.in(-4, 4), source.in(-4, 4), source.in(-4, 4)}));
        const tf::mesh a = moved(test::ball(1, 0.4), {source.in(-3, 3), source.in(-3, 3), 6.0});
        double least = std::numeric_limits<double>::infinity();
        for (const tf::mesh& part : among.meshes)
            least = std::min(least, tf::mesh_distance(a, part)->distance);
        const auto found = tf::mate(a, tf::face_tree(a), among.parts);
        REQUIRE(found.has_value());
        CHECK(found->nearest.distance == least);
        const auto settled = tf::settle_among(a, among.parts, found->motion, found->time);
        CHECK(settled.good);
        const tf::mesh there{settled.points, a.faces};
        CHECK(tf::mesh_distance(there, among.meshes[found->part])->distance < 1e-14);
    }
}

TEST_CASE("mate: progress goes from 0 to 1, a stop is heard, threads change nothing") {
    still_parts among;
    among.add(test::ball(3, 1.0));
    among.add(moved(test::ball(3, 1.0), {5, 0, 0}));
    const tf::mesh a = moved(test::ball(3, 0.5), {2.25, 0.25, 3.0});
    const tf::tree<3> tree = tf::face_tree(a);
    std::vector<double> shares;
    const auto found = tf::mate(a, tree, among.parts, {.progress = [&](double done) {
                                    shares.push_back(done);
                                    return true;
                                }});
    CHECK_FALSE(found->cancelled);
    CHECK(std::is_sorted(shares.begin(), shares.end()));
    CHECK(shares.back() == 1.0);
    for (const std::size_t stop_at : {std::size_t{1}, shares.size() / 2}) {
        std::size_t heard = 0;
        CHECK(
            tf::mate(a, tree, among.parts, {.progress = [&](double) { return ++heard < stop_at; }})
                ->cancelled);
        CHECK(heard == stop_at);
    }
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        const auto same = tf::mate(a, tree, among.parts);
        CHECK(same->time == found->time);
        CHECK(same->motion == found->motion);
        CHECK(same->part == found->part);
    }
}
