/// \file
/// Of two meshes that are moved, only faces where both are get into trees, and none is missed.

#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/intersect/mesh_intersections.hpp>
#include <libmesh/intersect/overlap_trees.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

using tf::detail::intersect::overlap_trees;

/// Stretched at times, turned about two axes, then moved.
tf::transform<3> random_move(test::random& source, double reach, double most_stretch = 2.0) {
    const double a = source.in(0, 7), b = source.in(0, 7);
    const double stretch = source.below(3) == 0 ? source.in(1 / most_stretch, most_stretch) : 1.0;
    tf::transform<3> first, second;
    first.rows = {{{stretch * std::cos(a), -std::sin(a), 0, 0},
                   {stretch * std::sin(a), std::cos(a), 0, 0},
                   {0, 0, 1, 0}}};
    second.rows = {{{1, 0, 0, source.in(-reach, reach)},
                    {0, std::cos(b), -std::sin(b), source.in(-reach, reach)},
                    {0, std::sin(b), std::cos(b), source.in(-reach, reach)}}};
    return second.after(first);
}

tf::aabb<double, 3> box_of(const tf::mesh& mesh, const tf::transform<3>& move) {
    tf::aabb<double, 3> box;
    for (const tf::point3& p : mesh.points) box.include(move(p));
    return box;
}

/// Puts the box of moved `b` beside that of moved `a` along an axis, so that they touch or nearly
/// do.
void lay_beside(const tf::mesh& a, const tf::mesh& b, std::size_t axis,
                tf::mesh_pair_options& positions) {
    const double end = box_of(a, positions.transform_a).max[axis];
    double& shift = positions.transform_b.rows[axis][3];
    shift += end - box_of(b, positions.transform_b).min[axis];
}

/// The answers with trees over all faces, which are moved with the meshes.
void check_as_whole(const tf::mesh& a, const tf::mesh& b, const tf::mesh_pair_options& positions) {
    const auto tree_a = tf::build_face_tree(a), tree_b = tf::build_face_tree(b);
    tf::face_pair_options options;
    options.transform_a = positions.transform_a;
    options.transform_b = positions.transform_b;
    const auto whole = tf::detail::intersect::mesh_intersections(a, tree_a, b, tree_b, options);
    const auto part = tf::mesh_intersections(a, b, options);
    REQUIRE(part.pairs == whole.pairs);
    CHECK(part.counts == whole.counts);
    CHECK(tf::intersects(a, b, positions) == !whole.pairs.empty());
    CHECK(tf::detail::intersect::intersects(a, tree_a, b, tree_b, positions) ==
          !whole.pairs.empty());
}

}  // namespace

TEST_CASE("overlap_trees: the answers are those of whole trees, wherever meshes are moved") {
    test::random source(1);
    std::size_t apart = 0, met = 0;
    for (int i = 0; i < 400; ++i) {
        CAPTURE(i);
        const tf::mesh a = i % 2 == 0 ? test::ball(2, 1.0) : test::random_soup(source, 100, 0.3);
        const tf::mesh b = i % 3 == 0 ? test::box(1, 1, 1) : test::ball(2, 0.5);
        tf::mesh_pair_options positions;
        if (i % 4 != 1) positions.transform_a = random_move(source, 1.5);
        if (i % 4 != 2) positions.transform_b = random_move(source, 1.5);
        if (i % 5 == 0) lay_beside(a, b, source.below(3), positions);
        check_as_whole(a, b, positions);
        ++(tf::intersects(a, b, positions) ? met : apart);
    }
    CHECK(met > 50);
    CHECK(apart > 50);
}

TEST_CASE("overlap_trees: boxes that touch keep the faces that do, a hair apart none") {
    const tf::mesh a = test::box(1, 1, 1), b = test::box(2, 3, 1);
    tf::mesh_pair_options positions;
    // A quarter of a turn about z: x is from 1 to 4, y from 0 to 2.
    positions.transform_b.rows = {{{0, -1, 0, 4}, {1, 0, 0, 0}, {0, 0, 1, 0}}};
    check_as_whole(a, b, positions);
    CHECK(tf::intersects(a, b, positions));
    const auto [tree_a, tree_b] = overlap_trees("test", a, b, positions);
    CHECK(tree_a.size() == 10);  // all but those at x = 0
    CHECK(tree_b.size() == 8);   // all but those at x = 4 and y = 2
    positions.transform_b.rows[0][3] = std::nextafter(4.0, 5.0);
    check_as_whole(a, b, positions);
    CHECK_FALSE(tf::intersects(a, b, positions));
    const auto [none_a, none_b] = overlap_trees("test", a, b, positions);
    CHECK(none_a.size() == 0);
    CHECK(none_b.size() == 0);
    const auto result = tf::mesh_intersections(
        a, b, {.transform_a = positions.transform_a, .transform_b = positions.transform_b});
    CHECK(result.box_pairs == 0);
}

TEST_CASE("overlap_trees: roundings of a move are in the boxes") {
    // What touches, except for how moved corners are rounded, at thirds.
    test::random source(2);
    std::size_t met = 0, apart = 0;
    for (int i = 0; i < 300; ++i) {
        CAPTURE(i);
        const tf::mesh a = test::box(1, 1, 1), b = test::box(1, 1, 1);
        tf::mesh_pair_options positions{random_move(source, 1e3), {}};
        positions.transform_b =
            positions.transform_a.after(tf::transform<3>::translation(tf::point3{1, 1.0 / 3, 0}));
        check_as_whole(a, b, positions);
        ++(tf::intersects(a, b, positions) ? met : apart);
    }
    CHECK(met > 0);
    for (int i = 0; i < 300; ++i) {  // in line with the axes: boxes are as near as the faces are
        CAPTURE(i);
        const tf::mesh a = test::box(1, 1, 1);
        tf::mesh_pair_options positions;
        for (std::size_t k = 0; k < 3; ++k) {
            positions.transform_a.rows[k][k] = source.in(0.1, 3);
            positions.transform_b.rows[k][k] = source.in(0.1, 3);
            positions.transform_a.rows[k][3] = source.in(-1, 1);
            positions.transform_b.rows[k][3] = positions.transform_a.rows[k][3];
        }
        lay_beside(a, a, source.below(3), positions);
        check_as_whole(a, a, positions);
        ++(tf::intersects(a, a, positions) ? met : apart);
    }
    CHECK(apart > 0);
}

TEST_CASE("overlap_trees: faces far from the other mesh are left out") {
    const tf::mesh a = test::ball(5, 1.0), b = test::ball(4, 1.0);
    test::random source(3);
    for (int i = 0; i < 20; ++i) {
        tf::mesh_pair_options positions{random_move(source, 0), random_move(source, 0)};
        const auto near = box_of(b, positions.transform_b);
        const double end = box_of(a, positions.transform_a).max[0];
        positions.transform_b.rows[0][3] += 0.99 * (end - near.min[0]);
        const auto [tree_a, tree_b] = overlap_trees("test", a, b, positions);
        CHECK(10 * tree_a.size() < a.faces.size());
        CHECK(10 * tree_b.size() < b.faces.size());
        check_as_whole(a, b, positions);
    }
}

TEST_CASE("overlap_trees: where most faces are near the other mesh, all are in the trees") {
    const tf::mesh a = test::ball(5, 1.0), b = test::ball(4, 1.0);
    test::random source(4);
    for (int i = 0; i < 10; ++i) {
        const tf::mesh_pair_options positions{random_move(source, 0.1, 1.1),
                                              random_move(source, 0.1, 1.1)};
        const auto [tree_a, tree_b] = overlap_trees("test", a, b, positions);
        CHECK(tree_a.size() == a.faces.size());
        CHECK(tree_b.size() == b.faces.size());
        check_as_whole(a, b, positions);
    }
    check_as_whole(a, b, {});
}

TEST_CASE("overlap_trees: refuses what is not finite once it is moved, and names the face") {
    const tf::mesh sheet = test::grid(4);
    tf::mesh_pair_options far;
    far.transform_b.rows[0][0] = 1e308;
    far.transform_b.rows[0][3] = 1.7e308;
    CHECK_THROWS_WITH_AS((void)tf::intersects(sheet, sheet, far),
                         doctest::Contains("intersects: b: face 0 has a corner that is not finite"),
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(
        (void)tf::mesh_intersections(sheet, sheet, {.transform_b = far.transform_b}),
        doctest::Contains("mesh_intersections: b: face 0"), std::invalid_argument);
    far.transform_a.rows[1][1] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH_AS((void)tf::intersects(sheet, sheet, far),
                         doctest::Contains("a transform is not finite"), std::invalid_argument);
}
