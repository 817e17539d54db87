#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/mesh/time_of_impact.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace {

using test::ball;
using test::box;
using test::moved;

constexpr int many = 10000;

/// Direction `i` of many that are spread over the sphere.
tf::point3 direction(int i) {
    const double n = i + 0.25, z = 1.0 - 2.0 * n / many, r = std::sqrt(1.0 - z * z);
    const double at = std::numbers::pi * (3.0 - std::sqrt(5.0)) * n;
    return {r * std::cos(at), r * std::sin(at), z};
}

double along(const tf::point3& p, const tf::point3& d) { return p.x * d.x + p.y * d.y + p.z * d.z; }

/// How far `a` goes this way until a plane separates it from `b`.
double to_separation(const tf::mesh& a, const tf::mesh& b, const tf::point3& d) {
    double last = std::numeric_limits<double>::infinity(), first = -last;
    for (const tf::point3& p : a.points) last = std::min(last, along(p, d));
    for (const tf::point3& p : b.points) first = std::max(first, along(p, d));
    return first - last;
}

double least_separation(const tf::mesh& a, const tf::mesh& b) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < many; ++i) least = std::min(least, to_separation(a, b, direction(i)));
    return least;
}

/// The least way, of many directions, from where a plane separates them back to the first contact.
double least_exit(const tf::mesh& a, const tf::mesh& b) {
    const auto pa = tf::prepared_mesh::borrow(a), pb = tf::prepared_mesh::borrow(b);
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < many; ++i) {
        const tf::point3 d = direction(i);
        const double out = to_separation(a, b, d) * (1.0 + 1e-9);
        tf::impact_options options;
        options.transform_a =
            tf::transform<3>::translation(tf::point3{d.x * out, d.y * out, d.z * out});
        const auto back = tf::time_of_impact(pa, pb, {-d.x, -d.y, -d.z}, options);
        least =
            std::min(least, back.outcome == tf::placement_outcome::contact ? out - back.time : out);
    }
    return least;
}

/// Verified: it takes `a` out. Returns the depth.
double depth_of(const tf::mesh& a, const tf::mesh& b) {
    const auto found = tf::penetration_depth(a, b);
    REQUIRE(found.has_value());
    REQUIRE(found->status == tf::status::ok);
    CHECK(found->depth == std::hypot(found->move.x, found->move.y, found->move.z));
    CHECK(tf::relation(moved(a, found->move), b).relation != tf::mesh_relation::penetrating);
    return found->depth;
}

/// Two bars at a right angle.
tf::mesh l_shape() { return test::together(box(3, 1, 1), moved(box(1, 3, 1), {0, 1, 0})); }

/// Triangles of length 2 and width 0.001 all ways through a cube of side 2.
tf::mesh needles(unsigned seed, std::uint32_t count) {
    test::random source(seed);
    tf::mesh made;
    for (std::uint32_t i = 0; i < count; ++i) {
        tf::point3 c, d;
        double length = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            c[k] = source.in(-1.0, 1.0);
            d[k] = source.in(-1.0, 1.0);
            length += d[k] * d[k];
        }
        for (std::size_t k = 0; k < 3; ++k) d[k] /= std::sqrt(length);
        made.points.push_back({c.x - d.x, c.y - d.y, c.z - d.z});
        made.points.push_back({c.x + d.x, c.y + d.y, c.z + d.z});
        made.points.push_back({c.x + d.x + 0.001 * d.y, c.y + d.y - 0.001 * d.x, c.z + d.z});
        made.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return made;
}

}  // namespace

TEST_CASE("depth: there is none apart, touching, of open sheets side by side, or of a cloud") {
    const tf::mesh a = box(1, 1, 1);
    CHECK_FALSE(tf::penetration_depth(a, moved(a, {2, 0, 0})).has_value());
    CHECK_FALSE(tf::penetration_depth(a, moved(a, {1, 0, 0})).has_value());
    CHECK_FALSE(tf::penetration_depth(a, tf::mesh{}).has_value());
    CHECK_FALSE(tf::penetration_depth(tf::mesh{}, a).has_value());
    const std::vector<tf::point3> cloud{{0.5, 0.5, 0.5}};
    CHECK_FALSE(tf::penetration_depth(cloud, tf::prepared_mesh::borrow(a)).has_value());
}

TEST_CASE("depth: of two boxes it is their least overlap, also of one inside the other") {
    const tf::mesh big = box(4, 5, 6);
    CHECK(depth_of(moved(box(1, 1, 1), {3.75, 2, 2}), big) == 0.25);
    CHECK(depth_of(moved(box(2, 2, 2), {1, -1.5, 1}), big) == 0.5);
    CHECK(depth_of(moved(box(1, 1, 1), {1, 2, 2.5}), big) == 2.0);
    CHECK(depth_of(big, moved(box(1, 1, 1), {1, 2, 2.5})) == 2.0);
    CHECK(depth_of(big, big) == 4.0);
}

TEST_CASE("depth: of convex bodies it is not above the best of 10^4 directions") {
    test::random source(3);
    for (int round = 0; round < 12; ++round) {
        CAPTURE(round);
        const tf::mesh a = round % 2 == 0 ? test::random_tetrahedron(source, 2.0) : ball(2, 1.0);
        const tf::mesh b =
            moved(round % 3 == 0 ? ball(2, 1.0) : test::turned(box(1, 2, 1.5), {1, 2, 3}, 0.7),
                  {source.in(-0.3, 0.3), source.in(-0.3, 0.3), source.in(-0.3, 0.3)});
        if (tf::relation(a, b).relation != tf::mesh_relation::penetrating) continue;
        CHECK(depth_of(a, b) <= least_separation(a, b) * (1.0 + 1e-12));
    }
}

TEST_CASE(
    "depth: of L shapes that hook into each other it is not above the best of 10^4 directions") {
    test::random source(4);
    for (int round = 0; round < 4; ++round) {
        CAPTURE(round);
        const tf::mesh a = l_shape();
        const tf::mesh b = moved(test::turned(l_shape(), {0, 0, 1}, 3.0 + 0.1 * round),
                                 {source.in(1.5, 2.5), source.in(1.5, 2.5), source.in(-0.4, 0.4)});
        if (tf::relation(a, b).relation != tf::mesh_relation::penetrating) continue;
        CHECK(depth_of(a, b) <= least_exit(a, b) * (1.0 + 1e-9));
    }
}

TEST_CASE("depth: of a flat body on a face the moves that lead out are as small as numbers are") {
    const tf::mesh flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {1, 0, 2}}};
    const tf::mesh cube = box(1, 1, 1);
    REQUIRE(tf::relation(flat, cube).relation == tf::mesh_relation::penetrating);
    const auto found = tf::penetration_depth(flat, cube);
    REQUIRE(found.has_value());
    CHECK(found->status == tf::status::ok);
    CHECK(found->depth > 0.0);
    CHECK(found->depth < 1e-15);
    CHECK(tf::relation(moved(flat, found->move), cube).relation != tf::mesh_relation::penetrating);
}

TEST_CASE("depth: of crowds of long thin faces it ends by its effort, with a move that leads out") {
    const tf::mesh a = needles(1, 1000), b = moved(needles(2, 1000), {0.125, 0, 0});
    REQUIRE(tf::relation(a, b).relation == tf::mesh_relation::penetrating);
    tf::measure_options options;
    for (const std::uint64_t bound : {1U, 1000U, 1'000'000U}) {
        CAPTURE(bound);
        options.effort = bound;
        const auto found = tf::penetration_depth(a, b, options);
        REQUIRE(found.has_value());
        REQUIRE(found->status == tf::status::ok);
        CHECK(found->effort.bound == bound);
        CHECK(found->effort.pairs <= bound);
        CHECK(found->effort.skipped_candidates > 0);
        CHECK(found->depth < 5.0);  // the boxes are 4 wide
        CHECK(tf::relation(moved(a, found->move), b).relation != tf::mesh_relation::penetrating);
        const auto again = tf::penetration_depth(a, b, options);
        CHECK(again->effort == found->effort);
        CHECK(again->move == found->move);
    }
    const auto whole = tf::penetration_depth(box(1, 1, 1), moved(box(1, 1, 1), {0.5, 0, 0}));
    CHECK(whole->effort.skipped_candidates == 0);
    CHECK(whole->effort.pairs > 0);
}

TEST_CASE("separate: of crowds of long thin faces it ends by its effort, where it keeps off") {
    const tf::mesh a = needles(1, 500), b = moved(needles(2, 500), {0.125, 0, 0});
    for (const std::uint64_t bound : {1U, 100'000U}) {
        CAPTURE(bound);
        const auto apart = tf::separate(a, b, {.effort = bound});
        REQUIRE(apart);
        CHECK(apart.effort.pairs <= bound);
        CHECK(apart.effort.skipped_candidates > 0);
        CHECK(apart.relation != tf::mesh_relation::penetrating);
        CHECK(tf::relation({apart.points, a.faces}, b).relation != tf::mesh_relation::penetrating);
    }
}

TEST_CASE("depth: it stops when told to, and names a bad face") {
    const tf::mesh a = ball(3, 1.0), b = moved(a, {0.5, 0, 0});
    const auto pa = tf::prepared_mesh::borrow(a), pb = tf::prepared_mesh::borrow(b);
    int asked = 0;
    tf::measure_options options;
    options.progress = [&](double) { return ++asked < 8; };
    CHECK(tf::penetration_depth(pa, pb, options)->status == tf::status::cancelled);
    tf::mesh bad = a;
    bad.points[0].x = std::nan("");
    CHECK_THROWS_AS(static_cast<void>(tf::penetration_depth(bad, b)), std::invalid_argument);
}

TEST_CASE("sides: points are counted inside, on and outside of several solids") {
    std::vector<tf::prepared_mesh> solids;
    solids.emplace_back(box(1, 1, 1));
    solids.emplace_back(moved(box(1, 1, 1), {0.5, 0, 0}));
    tf::mesh open = moved(box(1, 1, 1), {9, 0, 0});
    open.faces.pop_back();
    solids.emplace_back(tf::mesh(open));
    const std::vector<tf::point3> points{{0.25, 0.5, 0.5}, {1, 0.5, 0.5}, {0, 0.5, 0.5},
                                         {1.5, 0.5, 0.5},  {5, 5, 5},     {9.5, 0.5, 0.5}};
    const auto [inside, on, outside] = tf::count_sides(points, solids);
    CHECK(inside == 2);  // the second is on the first box and inside the other
    CHECK(on == 2);
    CHECK(outside == 2);
    CHECK(tf::count_sides({}, solids)[0] == 0);
    const std::vector<tf::point3> bad{{0, 0, 0}, {0, std::nan(""), 0}};
    CHECK_THROWS_WITH_AS(static_cast<void>(tf::count_sides(bad, solids)),
                         "treeform::count_sides: point 1 is not finite", std::invalid_argument);
}

TEST_CASE("sides: the counts are those of the points one by one") {
    test::random source(6);
    std::vector<tf::prepared_mesh> solid;
    solid.emplace_back(ball(4, 1.0));
    std::vector<tf::point3> points;
    for (int i = 0; i < 5000; ++i)
        points.push_back({source.in(-1.2, 1.2), source.in(-1.2, 1.2), source.in(-1.2, 1.2)});
    const auto each = tf::locate(solid[0], points);
    const auto inside = std::count_if(each.begin(), each.end(), [](const auto& one) {
        return one.where == tf::location::inside;
    });
    CHECK(tf::count_sides(points, solid)[0] == static_cast<std::uint64_t>(inside));
}
