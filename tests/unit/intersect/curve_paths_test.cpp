/// \file
/// Curves joined into paths: how many, closed or not, and named by what.

#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

namespace {

tf::curve_network paths_of(const tf::mesh& mesh) {
    return tf::intersection_paths(mesh, tf::self_intersections(mesh).pairs);
}

std::size_t segments_of(const tf::curve_network& network) {
    std::size_t count = 0;
    for (const tf::curve_path& path : network.paths)
        count += path.points.size() - (path.closed ? 0 : 1);
    return count;
}

}  // namespace

TEST_CASE("curve paths: two faces that cross give one open path, its ends named") {
    const tf::mesh mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {2, 1, 1}},
                        {{0, 1, 2}, {3, 4, 5}}};
    const auto network = paths_of(mesh);
    REQUIRE(network.paths.size() == 1);
    const tf::curve_path& path = network.paths[0];
    CHECK(!path.closed);
    CHECK(path.pairs == std::vector<std::uint32_t>{0});
    REQUIRE(path.points.size() == 2);
    std::set<std::array<std::uint32_t, 2>> edges;
    for (const std::uint32_t p : path.points) {
        CHECK(network.points[p].by[1] == tf::curve_point::none);
        CHECK(network.points[p].by[0] == 0);
        edges.insert(network.points[p].edge);
    }
    CHECK(edges == std::set<std::array<std::uint32_t, 2>>{{3, 4}, {3, 5}});
}

TEST_CASE("curve paths: two balls meet in one closed path") {
    const tf::mesh mesh =
        test::together(test::ball(3, 1.0), test::moved(test::ball(3, 1.0), {0.7, 0.3, 0.1}));
    const auto network = paths_of(mesh);
    REQUIRE(network.paths.size() == 1);
    CHECK(network.paths[0].closed);
    CHECK(network.paths[0].points.size() == network.points.size());
    // In general position every point is an edge through a face, and lies on both balls.
    for (const tf::curve_point& p : network.points) {
        CHECK(p.by[1] == tf::curve_point::none);
        const double radius = std::hypot(p.position.x, p.position.y, p.position.z);
        CHECK(radius <= 1.0 + 1e-12);
        CHECK(radius > 0.95);
    }
    CHECK(network.paths[0].pairs.size() == network.paths[0].points.size());
}

TEST_CASE("curve paths: a square tube through a plate leaves two loops") {
    const tf::mesh tube = test::moved(test::box(1, 1, 6), {1.25, 1.5, -2});
    const tf::mesh mesh = test::together(test::box(4, 4, 1), tube);
    const auto network = paths_of(mesh);
    CHECK(network.paths.size() == 2);
    for (const tf::curve_path& path : network.paths) CHECK(path.closed);
}

TEST_CASE("curve paths: a corner on a face is a point, named by its number") {
    const tf::mesh mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {1, 1, 1}, {2, 1, 1}},
                        {{0, 1, 2}, {3, 4, 5}}};
    const auto network = paths_of(mesh);
    REQUIRE(network.paths.size() == 1);
    CHECK(network.paths[0].points.size() == 1);
    CHECK(!network.paths[0].closed);
    CHECK(network.points[network.paths[0].points[0]] == tf::curve_point{{3, 3}, {3, 3}, {1, 1, 0}});
}

TEST_CASE("curve paths: the rim of an overlap is closed, common to all who have it") {
    const tf::mesh mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {5, 1, 0}, {1, 5, 0}},
                        {{0, 1, 2}, {3, 4, 5}}};
    const auto network = paths_of(mesh);
    REQUIRE(network.paths.size() == 1);
    CHECK(network.paths[0].closed);
    CHECK(network.paths[0].points.size() == 3);
}

TEST_CASE("curve paths: points with several names are one") {
    // The edges of two boxes cross in (1, 1, z): eight faces meet in each such point.
    const tf::mesh mesh =
        test::together(test::box(2, 2, 2), test::moved(test::box(2, 2, 2), {1, 1, 1}));
    const auto network = paths_of(mesh);
    std::set<std::array<double, 3>> positions;
    for (const tf::curve_point& p : network.points)
        positions.insert({p.position.x, p.position.y, p.position.z});
    CHECK(positions.size() == network.points.size());
    CHECK(segments_of(network) > 0);
}

TEST_CASE("curve paths: no path ends where two segments meet, on any number of threads") {
    test::random source(3);
    for (int round = 0; round < 20; ++round) {
        CAPTURE(round);
        const tf::mesh mesh = test::random_soup(source, 60, 0.4);
        const auto network = paths_of(mesh);
        std::vector<int> ends(network.points.size());
        std::vector<int> uses(network.points.size());
        for (const tf::curve_path& path : network.paths) {
            REQUIRE(path.pairs.size() == path.points.size() - (path.closed ? 0 : 1));
            for (const std::uint32_t p : path.points) ++uses[p];
            if (path.closed) continue;
            ++ends[path.points.front()];
            ++ends[path.points.back()];
        }
        for (std::size_t p = 0; p < ends.size(); ++p) {
            CHECK(ends[p] != 2);
            if (ends[p] == 0) CHECK(uses[p] == 1);
        }
        CHECK(segments_of(network) == tf::self_intersections(mesh).pairs.size());
        const tf::thread_scope one(1);
        const auto again = paths_of(mesh);
        CHECK(again.points == network.points);
        CHECK(again.paths == network.paths);
    }
}

TEST_CASE("curve paths: faces without area have none, and change no others") {
    tf::mesh mesh = test::together(test::box(2, 2, 2), test::moved(test::box(2, 2, 2), {1, 1, 1}));
    const auto network = paths_of(mesh);
    mesh.faces.insert(mesh.faces.end(), {{0, 0, 6}, {0, 14, 14}});
    const auto found = tf::self_intersections(mesh);
    REQUIRE(found.counts[tf::pair_kind::degenerate] > 0);
    const auto again = tf::intersection_paths(mesh, found.pairs);
    CHECK(again.points == network.points);
    REQUIRE(again.paths.size() == network.paths.size());
    for (std::size_t i = 0; i < again.paths.size(); ++i) {
        CHECK(again.paths[i].points == network.paths[i].points);
        for (const std::uint32_t pair : again.paths[i].pairs)
            CHECK(found.pairs.at(pair).kind != tf::pair_kind::degenerate);
    }
}
