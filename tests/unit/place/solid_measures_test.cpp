/// \file
/// The smallest box around points, hulls as meshes, how thick walls are.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/convex_hull.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/aabb.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace {

double product(const tf::point3& a, const tf::point3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// A rotation about a random axis.
tf::transform<3> turn_of(test::random& random) {
    std::array<double, 4> q{};
    double sum = 0.0;
    for (double& v : q) v = random.in(-1, 1), sum += v * v;
    const double s = std::sqrt(sum), w = q[0] / s, x = q[1] / s, y = q[2] / s, z = q[3] / s;
    return {{{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 5},
              {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), -7},
              {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), 1}}}};
}

}  // namespace

TEST_CASE("oriented box: turned boxes have their own, and points are in it") {
    test::random random(11);
    for (int round = 0; round < 50; ++round) {
        CAPTURE(round);
        const tf::point3 size{random.in(4, 5), random.in(2, 3), random.in(0.5, 1)};
        std::vector<tf::point3> points = test::box(size.x, size.y, size.z).points;
        for (int i = 0; i < 40; ++i)
            points.push_back({random.in(0, size.x), random.in(0, size.y), random.in(0, size.z)});
        const tf::transform<3> turn = turn_of(random);
        for (tf::point3& p : points) p = turn(p);
        const auto box = tf::find_oriented_box(points);
        REQUIRE(box);
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(box->size[k] == doctest::Approx(size[k]).epsilon(1e-12));
            for (const tf::point3& p : points)
                CHECK(std::abs(product(box->axes[k], p) - product(box->axes[k], box->center)) <=
                      box->size[k] / 2 + 1e-13);
        }
        const tf::point3 &x = box->axes[0], &y = box->axes[1], &z = box->axes[2];
        CHECK(
            std::abs(
                product({x.y * y.z - x.z * y.y, x.z * y.x - x.x * y.z, x.x * y.y - x.y * y.x}, z) -
                1.0) < 1e-12);
    }
}

TEST_CASE("oriented box: never larger than the one along the axes; flat, straight, single points") {
    test::random random(12);
    for (int round = 0; round < 30; ++round) {
        std::vector<tf::point3> points;
        for (int i = 0; i < 4 + 10 * round; ++i)
            points.push_back({random.in(-1, 1), random.in(-3, 3), random.in(-1, 1)});
        const auto box = tf::find_oriented_box(points);
        const tf::box3 straight = tf::bounding_box(points).value();
        CHECK(box->size.x * box->size.y * box->size.z <=
              1.0000001 * (straight.max.x - straight.min.x) * (straight.max.y - straight.min.y) *
                  (straight.max.z - straight.min.z));
    }
    CHECK_FALSE(tf::find_oriented_box({}));
    const std::vector<tf::point3> one{{3, 4, 5}}, line{{0, 0, 0}, {3, 4, 0}, {1.5, 2, 0}},
        flat{{0, 0, 1}, {2, 2, 1}, {1, 3, 1}, {-1, 1, 1}};
    CHECK(tf::find_oriented_box(one)->size == tf::point3{});
    CHECK(tf::find_oriented_box(one)->center == one[0]);
    CHECK(tf::find_oriented_box(line)->size.x == doctest::Approx(5));
    CHECK(tf::find_oriented_box(line)->size.y == doctest::Approx(0));
    CHECK(tf::find_oriented_box(flat)->size.x == doctest::Approx(std::sqrt(8)));
    CHECK(tf::find_oriented_box(flat)->size.y == doctest::Approx(std::sqrt(2)));
    CHECK(tf::find_oriented_box(flat)->size.z == doctest::Approx(0));
}

TEST_CASE("a hull as a mesh is closed, and has the points that it uses") {
    test::random random(13);
    std::vector<tf::point3> points;
    for (int i = 0; i < 500; ++i)
        points.push_back({random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)});
    const auto hull = tf::convex_hull(points);
    const tf::mesh mesh = hull.mesh(points);
    CHECK(mesh.faces.size() == hull.faces.size());
    CHECK(mesh.points.size() < points.size());
    const auto counts = tf::count_topology(mesh.points.size(), mesh.faces);
    CHECK(counts.closed_manifold);
    CHECK(counts.points_used == mesh.points.size());
    CHECK(tf::signed_volume(mesh) > 0);
}

TEST_CASE("wall thickness: a hollow box, a ball, a sheet") {
    const tf::mesh outer = test::box(10, 10, 10);
    tf::mesh inner = test::box(8, 8, 9);
    for (tf::point3& p : inner.points) p = {p.x + 1, p.y + 1, p.z + 0.5};
    const tf::mesh hollow = tf::difference(outer, inner).value();
    const auto walls = tf::wall_thickness(hollow);
    CHECK(walls.min == doctest::Approx(0.5));
    for (const double t : walls.of_face)
        CHECK(
            (t == doctest::Approx(0.5) || t == doctest::Approx(1.0) || t == doctest::Approx(10.0)));
    const tf::mesh ball = test::ball(4, 2.0);
    const auto rays = tf::wall_thickness(ball);
    const auto balls = tf::wall_thickness(ball, tf::thickness_by::sphere);
    for (std::size_t f = 0; f < ball.faces.size(); ++f) {
        CHECK(rays.of_face[f] == doctest::Approx(4).epsilon(0.05));
        CHECK(balls.of_face[f] <= rays.of_face[f]);
        tf::point3 center;  // of the ball: nothing of the surface is within
        const auto [a, b, c] = ball.faces[f];
        const tf::point3 &p = ball.points[a], &q = ball.points[b], &r = ball.points[c];
        const tf::point3 u{q.x - p.x, q.y - p.y, q.z - p.z}, v{r.x - p.x, r.y - p.y, r.z - p.z};
        const tf::point3 n{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
        const double radius = balls.of_face[f] / 2;
        for (std::size_t k = 0; k < 3; ++k)
            center[k] = (p[k] + q[k] + r[k]) / 3 - radius * n[k] / std::sqrt(product(n, n));
        if (f % 16 == 0) CHECK(tf::closest_point(ball, center)->distance >= radius * (1 - 1e-5));
    }
    const tf::mesh sheet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 1, 3}}};
    const auto open = tf::wall_thickness(sheet);
    CHECK(open.of_face == std::vector<double>(2, std::numeric_limits<double>::infinity()));
    CHECK(tf::wall_thickness(ball, tf::thickness_by::ray, [](double) { return false; }).status ==
          tf::status::cancelled);
}
