#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/exact/plane_predicates.hpp>
#include <libmesh/geometry/contact_order.hpp>
#include <libmesh/intersect/point_locator.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

namespace {

using test::triangle_of;

/// Counts the crossings of rays in random directions until one meets interiors only.
tf::point_location by_random_rays(test::random& random, const tf::mesh& mesh, const tf::point3& q) {
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        if (tf::intersect(triangle_of(mesh, f), {q, q, q}).count != 0)
            return {tf::location::boundary, 0, f};
    for (;;) {
        const tf::point3 d{random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)};
        tf::point_location found;
        bool grazed = false;
        for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
            const tf::triangle3 t = triangle_of(mesh, f);
            const auto hit = tf::intersect({{q.x, q.y, q.z}, {d.x, d.y, d.z}}, t);
            if (!hit) continue;
            grazed |= hit->coplanar || hit->at != tf::triangle_feature::interior;
            found.winding += tf::direction_side(t[0], t[1], t[2], d);
        }
        if (grazed) continue;
        found.where = found.winding != 0 ? tf::location::inside : tf::location::outside;
        return found;
    }
}

/// Tetrahedra on some points of a small lattice, either way round, flat ones among them: they
/// overlap, share corners, edges and faces, and are closed as a whole.
tf::mesh tetrahedra(test::random& random, std::size_t count, std::size_t points, std::size_t side) {
    tf::mesh m = test::lattice_soup(random, 0, points, side);
    const auto any = [&] { return static_cast<std::uint32_t>(random.below(points)); };
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t a = any(), b = any(), c = any(), d = any();
        m.faces.insert(m.faces.end(), {{a, b, c}, {a, d, b}, {b, d, c}, {c, d, a}});
    }
    return m;
}

std::vector<tf::point3> lattice(int side, double step, double offset = 0.0) {
    std::vector<tf::point3> points;
    for (int x = 0; x <= side; ++x)
        for (int y = 0; y <= side; ++y)
            for (int z = 0; z <= side; ++z)
                points.push_back({x * step + offset, y * step + offset, z * step + offset});
    return points;
}

TEST_CASE("point location: agrees with rays in random directions, on every kind of closed mesh") {
    std::array<int, 3> seen{};
    std::int32_t most = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        CAPTURE(seed);
        test::random random(seed);
        const tf::mesh mesh = tetrahedra(random, 1 + seed % 12, 6 + seed % 12, 4);
        const auto tree = tf::build_face_tree(mesh);
        const tf::detail::intersect::point_locator locator(mesh, tree);
        const auto points = lattice(6, 0.5);
        const auto found = locator.locate(points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto expected = by_random_rays(random, mesh, points[i]);
            CHECK(found[i] == expected);
            ++seen[static_cast<std::size_t>(expected.where)];
            most = std::max(most, std::abs(expected.winding));
        }
    }
    for (const int count : seen) CHECK(count > 100);
    CHECK(most >= 2);
}

/// The cube [0, 1]^3, faces outward.
tf::mesh cube() {
    return {
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}},
        {{0, 2, 1},
         {1, 2, 3},
         {4, 5, 6},
         {5, 7, 6},
         {0, 1, 4},
         {1, 5, 4},
         {2, 6, 3},
         {3, 6, 7},
         {0, 4, 2},
         {2, 4, 6},
         {1, 3, 5},
         {3, 7, 5}}};
}

tf::point_location located(const tf::mesh& mesh, const tf::point3& p) {
    const auto tree = tf::build_face_tree(mesh);
    return tf::detail::intersect::point_locator(mesh, tree).locate(p);
}

TEST_CASE("point location: a cube's inside winds once, its mirror image's once the other way") {
    const tf::point_location inside{tf::location::inside, 1, 0};
    const tf::point_location outside{};
    CHECK(located(cube(), {0.5, 0.5, 0.5}) == inside);
    CHECK(located(cube(), {0x1p-1074, 0.5, 0.5}) == inside);
    CHECK(located(cube(), {-0x1p-1074, 0.5, 0.5}) == outside);
    CHECK(located(cube(), {1.0 - 0x1p-53, 1.0 - 0x1p-53, 1.0 - 0x1p-53}) == inside);
    CHECK(located(cube(), {-1, 0, 0}) == outside);  // the ray runs along an edge
    CHECK(located(cube(), {-1, 1, 1}) == outside);
    CHECK(located(cube(), {-1, 0.5, 0.5}) == outside);  // through diagonals of both sides
    CHECK(located(cube(), {-0.0, 0.5, 0.5}).where == tf::location::boundary);
    CHECK(located(cube(), {1, 1, 1}).where == tf::location::boundary);
    CHECK(located(cube(), {1, 1, 1}).on == 3);
    CHECK(located(cube(), {0.25, 1, 0}).where == tf::location::boundary);

    tf::mesh mirrored = cube();
    for (tf::face& f : mirrored.faces) std::swap(f[0], f[1]);
    CHECK(located(mirrored, {0.5, 0.5, 0.5}).winding == -1);
    CHECK(located(test::together(cube(), cube()), {0.5, 0.5, 0.5}).winding == 2);
    CHECK(located(test::together(cube(), mirrored), {0.5, 0.5, 0.5}) == outside);
    CHECK(located(test::together(cube(), mirrored), {0.5, 0.5, 1}).where == tf::location::boundary);
}

TEST_CASE("point location: scale, offset, order and threads do not matter") {
    test::random random(5);
    const tf::mesh mesh = tetrahedra(random, 8, 12, 4);
    const auto points = lattice(6, 0.5);
    const auto tree = tf::build_face_tree(mesh);
    const auto found = tf::detail::intersect::point_locator(mesh, tree).locate(points);
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        CHECK(tf::detail::intersect::point_locator(mesh, tree).locate(points) == found);
    }
    const auto same_place = [](const tf::point_location& a, const tf::point_location& b) {
        return a.where == b.where && a.winding == b.winding;
    };
    for (const double offset : {0.0, 0x1p30})
        for (const double scale : {0x1p-200, 1.0, 0x1p+900}) {
            const tf::mesh placed =
                test::scaled(test::moved(mesh, {offset, offset, offset}), scale);
            std::vector<tf::point3> there = lattice(6, 0.5, offset);
            for (tf::point3& p : there) p = {p.x * scale, p.y * scale, p.z * scale};
            const auto tree_or_transformed = tf::build_face_tree(placed);
            CHECK(tf::detail::intersect::point_locator(placed, tree_or_transformed).locate(there) ==
                  found);
        }
    const tf::mesh tiny = test::scaled(mesh, 0x1p-1073);
    for (std::size_t i = 0; i < points.size(); ++i)
        CHECK(located(tiny, {points[i].x * 0x1p-1073, points[i].y * 0x1p-1073,
                             points[i].z * 0x1p-1073}) == found[i]);
    const test::shuffled_mesh other = test::shuffled(random, mesh);
    const auto other_tree = tf::build_face_tree(other.mesh);
    const auto others = tf::detail::intersect::point_locator(other.mesh, other_tree).locate(points);
    for (std::size_t i = 0; i < points.size(); ++i) CHECK(same_place(others[i], found[i]));
}

TEST_CASE("point location: an open mesh is refused, naming the edge") {
    CHECK_FALSE(tf::find_open_edge(cube()));
    CHECK_FALSE(tf::find_open_edge({}));
    tf::mesh open = cube();
    open.faces.erase(open.faces.begin() + 3);
    const auto edge = tf::find_open_edge(open);
    REQUIRE(edge);
    CHECK(*edge == std::array<std::uint32_t, 2>{5, 6});
    CHECK_THROWS_WITH_AS((void)tf::locate(open, tf::point3{}),
                         "treeform::locate: the mesh is open at the edge between points 5 and 6",
                         std::invalid_argument);
    tf::mesh turned = cube();
    std::swap(turned.faces[0][0], turned.faces[0][1]);
    CHECK(tf::find_open_edge(turned));
    tf::mesh with_fin = cube();  // a face twice, either way round, and one that is an edge
    with_fin.faces.insert(with_fin.faces.end(), {{0, 3, 5}, {5, 3, 0}, {1, 1, 2}});
    CHECK_FALSE(tf::find_open_edge(with_fin));
}

TEST_CASE("point location: empty meshes and bad numbers") {
    const tf::mesh none;
    const auto tree = tf::build_face_tree(none);
    const tf::detail::intersect::point_locator locator(none, tree);
    CHECK(locator.locate(tf::point3{1, 2, 3}) == tf::point_location{});
    CHECK(locator.locate(std::vector<tf::point3>{}).empty());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH_AS(
        static_cast<void>(locator.locate(std::vector<tf::point3>{{}, {0, nan, 0}})),
        "treeform::locate: point 1 is not finite", std::invalid_argument);
}

struct curves {
    std::vector<tf::point2> points;
    std::vector<tf::curve_edge> edges;
};

/// Whole coordinates below 1000: no line in direction (2001, 1) holds two lattice points, so
/// nothing is ever grazed.
tf::point_location by_oblique_ray(const curves& c, const tf::point2& q) {
    const auto cross = [](double ax, double ay, double bx, double by) { return ax * by - ay * bx; };
    tf::point_location found;
    for (std::uint32_t e = 0; e < c.edges.size(); ++e) {
        const tf::point2 p = c.points[c.edges[e][0]], r = c.points[c.edges[e][1]];
        const double turn = cross(r.x - p.x, r.y - p.y, q.x - p.x, q.y - p.y);
        const double between = (p.x - q.x) * (r.x - q.x) + (p.y - q.y) * (r.y - q.y);
        if (turn == 0.0 && between <= 0.0) return {tf::location::boundary, 0, e};
        const bool from = cross(2001, 1, p.x - q.x, p.y - q.y) > 0;
        const bool to = cross(2001, 1, r.x - q.x, r.y - q.y) > 0;
        if (!from && to && turn > 0.0) ++found.winding;
        if (from && !to && turn < 0.0) --found.winding;
    }
    found.where = found.winding != 0 ? tf::location::inside : tf::location::outside;
    return found;
}

TEST_CASE("point location: closed curves agree with oblique rays, however they cross") {
    std::array<int, 3> seen{};
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        CAPTURE(seed);
        test::random random(seed);
        curves c;
        for (std::size_t i = 0; i < 3 + seed; ++i)
            c.points.push_back(
                {static_cast<double>(random.below(7)), static_cast<double>(random.below(7))});
        for (std::uint32_t i = 0; i < c.points.size(); ++i)
            c.edges.push_back({i, i + 1 < c.points.size() ? i + 1 : 0});
        if (seed % 3 == 0) std::swap(c.edges.front(), c.edges.back());
        const tf::curve_locator locator(c.points, c.edges);
        std::vector<tf::point2> points;
        for (int x = -1; x < 8; ++x)
            for (int y = -1; y < 8; ++y)
                points.push_back({static_cast<double>(x), static_cast<double>(y)});
        const auto found = locator.locate(points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto expected = by_oblique_ray(c, points[i]);
            CHECK(found[i] == expected);
            ++seen[static_cast<std::size_t>(expected.where)];
        }
    }
    for (const int count : seen) CHECK(count > 100);
}

TEST_CASE("point location: an open curve is refused, and an empty one holds nothing") {
    const curves none;
    CHECK(tf::curve_locator(none.points, none.edges).locate(tf::point2{}) == tf::point_location{});
    const curves open{{{0, 0}, {1, 0}, {0, 1}}, {{0, 1}, {1, 2}}};
    CHECK_THROWS_WITH_AS((tf::curve_locator{open.points, open.edges}),
                         "treeform::curve_locator: the curve is open at point 0",
                         std::invalid_argument);
    const curves wild{{{0, 0}}, {{0, 1}}};
    CHECK_THROWS_AS((tf::curve_locator{wild.points, wild.edges}), std::invalid_argument);
}

}  // namespace
