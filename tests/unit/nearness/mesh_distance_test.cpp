#include <libmesh/geometry/triangle_distance.hpp>
#include <libmesh/nearness/closest_pair.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/soups.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace {

using test::triangle_of;

tf::tree<3> tree_of(const tf::mesh& mesh) {
    return tf::build(mesh.faces, [&](const tf::face& f) {
        tf::aabb<double, 3> box;
        for (const std::uint32_t corner : f) box.include(mesh.points[corner]);
        return box;
    });
}

tf::closest_pair_result distance_by_brute_force(const tf::mesh& a, const tf::mesh& b) {
    tf::closest_pair_result best;
    double squared = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < a.faces.size(); ++i)
        for (std::uint32_t j = 0; j < b.faces.size(); ++j) {
            const auto found = tf::closest_pair(triangle_of(a, i), triangle_of(b, j));
            if (!(found.squared_distance < squared)) continue;
            squared = found.squared_distance;
            best = {i, j, std::sqrt(squared), found.on_a, found.on_b};
        }
    return best;
}

}  // namespace

TEST_CASE("closest points: corners, edges and insides of triangles are found") {
    const tf::triangle3 flat{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
    // a corner above the inside
    auto found = tf::closest_pair(flat, {{{1, 1, 2}, {1, 1, 5}, {3, 3, 5}}});
    CHECK(found.squared_distance == 4.0);
    CHECK(found.on_a == tf::point3{1, 1, 0});
    CHECK(found.on_b == tf::point3{1, 1, 2});
    // an edge across another
    found = tf::closest_pair(flat, {{{2, -1, 1}, {2, -1, 9}, {2, -3, 0}}});
    CHECK(found.squared_distance == doctest::Approx(2.0));
    found = tf::closest_pair(flat, {{{-1, -1, 3}, {1, -1, 3}, {0, -2, 9}}});
    CHECK(found.squared_distance == doctest::Approx(10.0));
    // through each other, no corner or edge near
    const tf::triangle3 wide{{{-100, -100, 0}, {100, -100, 0}, {0, 200, 0}}};
    found = tf::closest_pair(wide, {{{0, 0, -90}, {1, 0, 90}, {0, 1, 90}}});
    CHECK(found.squared_distance == 0.0);
    CHECK(found.on_a == found.on_b);
    // a degenerate one
    const tf::triangle3 point{{{0, 0, 7}, {0, 0, 7}, {0, 0, 7}}};
    CHECK(tf::closest_pair(flat, point).squared_distance == 49.0);
    CHECK(tf::closest_pair(point, point).squared_distance == 0.0);
}

TEST_CASE("mesh distance: a mesh without faces has none") {
    CHECK(!tf::closest_pair(tf::mesh{}, test::grid(2)));
    CHECK(!tf::closest_pair(test::grid(2), tf::mesh{}));
}

TEST_CASE("mesh distance: the nearest faces are those of a loop over all pairs") {
    test::random source(1);
    for (int round = 0; round < 12; ++round) {
        CAPTURE(round);
        const tf::mesh a = round % 3 == 0   ? test::grid(9)
                           : round % 3 == 1 ? test::random_soup(source, 200, 0.1)
                                            : test::lattice_soup(source, 150, 80, 6);
        const double x = round < 6 ? 9.0 : source.in(-1.0, 2.0);
        const tf::mesh b = test::moved(round % 2 == 0 ? test::random_soup(source, 150, 0.2)
                                                      : test::lattice_soup(source, 100, 80, 4),
                                       {x, source.in(-1, 1), source.in(-1, 1)});
        const tf::closest_pair_result expected = distance_by_brute_force(a, b);
        const auto found = tf::closest_pair(a, b);
        REQUIRE(found);
        REQUIRE(found->distance == expected.distance);
        if (expected.distance > 0.0) REQUIRE(*found == expected);
        CHECK(tf::closest_pair(a, b, {.radius = expected.distance}).has_value());
        if (expected.distance > 0.0)
            CHECK(!tf::closest_pair(a, b,
                                    {.radius = std::nextafter(expected.distance * 0.999999, 0.0)}));
    }
}

TEST_CASE("mesh distance: many equally near faces give one answer on any number of threads") {
    const tf::mesh a = test::grid(70);
    const tf::mesh b = test::moved(test::grid(70), {0.25, 0.5, 3});
    const auto expected = tf::closest_pair(a, b);
    CHECK(expected->distance == 3.0);
    CHECK(expected->face_a == 0);
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        CHECK(tf::closest_pair(a, b) == expected);
        CHECK(tf::closest_pair(a, a) == tf::closest_pair(a, a));
    }
}

TEST_CASE("mesh distance: a mesh that is treated as transformed is measured where it is") {
    test::random source(2);
    const tf::mesh a = test::random_soup(source, 300, 0.1);
    const tf::mesh b = test::random_soup(source, 300, 0.1);
    tf::transform<3> turn;
    turn.rows = {{{0.6, -0.8, 0, 3}, {0.8, 0.6, 0, 0.25}, {0, 0, 1, -0.5}}};
    tf::mesh there = b;
    for (tf::point3& p : there.points) p = turn(p);
    const tf::tree<3> tree_a = tree_of(a);
    const tf::tree<3> tree_b = tree_of(b);
    CHECK(tf::detail::nearness::closest_pair(a, tree_a, b, tf::transformed<3>(tree_b, turn)) ==
          tf::closest_pair(a, there));
}

TEST_CASE("mesh distance: a power of two changes nothing but the scale") {
    test::random source(3);
    const tf::mesh a = test::random_soup(source, 100, 0.1);
    const tf::mesh b = test::moved(test::random_soup(source, 100, 0.1), {3, 0, 0});
    const auto expected = tf::closest_pair(a, b);
    for (const double factor : {0x1p-900, 0x1p-300, 0x1p+300, 0x1p+1000}) {
        const auto found = tf::closest_pair(test::scaled(a, factor), test::scaled(b, factor));
        CHECK(found->face_a == expected->face_a);
        CHECK(found->face_b == expected->face_b);
        CHECK(found->distance == expected->distance * factor);
    }
}

TEST_CASE("mesh distance: what cannot be meant is refused") {
    const tf::mesh a = test::grid(2);
    const tf::tree<3> tree = tree_of(a);
    const tf::tree<3> other = tree_of(test::grid(3));
    CHECK_THROWS_AS((void)tf::detail::nearness::closest_pair(a, tree, a, other),
                    std::invalid_argument);
    CHECK_THROWS_AS((void)tf::closest_pair(a, a, {.radius = -1.0}), std::invalid_argument);
    tf::mesh bad = a;
    bad.faces[1][2] = 77;
    CHECK_THROWS_AS((void)tf::closest_pair(a, bad), std::invalid_argument);
}
