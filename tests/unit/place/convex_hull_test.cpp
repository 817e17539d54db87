#include <libmesh/exact/plane_predicates.hpp>
#include <treeform/mesh/convex_hull.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using points = std::vector<tf::point3>;

std::array<double, 3> key(const tf::point3& p) { return {p.x, p.y, p.z}; }

int above(const points& p, const tf::face& f, const tf::point3& q) {
    return tf::orient3d(p[f[0]], p[f[1]], p[f[2]], q);
}

/// What the header says of a hull that spans space, by looking at everything.
void check_operand(const points& p, const tf::convex_hull_result& hull) {
    REQUIRE(hull.dimension == 3);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> side_of_edge;
    std::size_t faces = 0;
    for (std::size_t s = 0; s < hull.sides.size(); ++s) {
        const tf::hull_side& side = hull.sides[s];
        CHECK(side.first_face == faces);
        faces += side.face_count;
        for (const tf::face& f : hull.faces_of(side)) {
            CHECK_FALSE(tf::collinear(p[f[0]], p[f[1]], p[f[2]]));
            CHECK(std::all_of(p.begin(), p.end(), [&](auto& q) { return above(p, f, q) <= 0; }));
            for (const std::uint32_t i : hull.faces[side.first_face]) CHECK(above(p, f, p[i]) == 0);
            for (std::size_t k = 0; k < 3; ++k)
                CHECK(side_of_edge.emplace(std::pair(f[k], f[(k + 1) % 3]), s).second);
        }
        CHECK(std::abs(std::hypot(side.normal.x, side.normal.y, side.normal.z) - 1.0) < 1e-15);
    }
    CHECK(faces == hull.faces.size());
    // closed; and what lies in one plane is one side
    for (const auto& [edge, side] : side_of_edge) {
        const auto other = side_of_edge.find({edge.second, edge.first});
        REQUIRE(other != side_of_edge.end());
        if (other->second == side) continue;
        const tf::face& f = hull.faces[hull.sides[side].first_face];
        const tf::face& g = hull.faces[hull.sides[other->second].first_face];
        CHECK(std::any_of(g.begin(), g.end(), [&](auto i) { return above(p, f, p[i]) != 0; }));
    }
    // a sphere: V - E + F = 2
    std::set<std::uint32_t> corners;
    for (const tf::face& f : hull.faces) corners.insert(f.begin(), f.end());
    CHECK(corners.size() + hull.faces.size() == side_of_edge.size() / 2 + 2);
}

using corner_set = std::set<std::array<double, 3>>;

/// The corners of each side, as coordinates.
std::set<corner_set> corners_by_hull(const points& p, const tf::convex_hull_result& hull) {
    std::set<corner_set> sides;
    for (const tf::hull_side& side : hull.sides) {
        corner_set one;
        for (const std::uint32_t i : hull.corners_of(side, p)) one.insert(key(p[i]));
        CHECK(sides.insert(one).second);
    }
    return sides;
}

bool between_points(const tf::point3& q, const tf::point3& a, const tf::point3& b) {
    return tf::collinear(a, b, q) && tf::compare_along(a, b, a, q) > 0 &&
           tf::compare_along(a, b, q, b) > 0;
}

bool strictly_in_triangle(const tf::point3& q, const tf::point3& a, const tf::point3& b,
                          const tf::point3& c) {
    for (int axis = 0; axis < 3; ++axis) {
        const int turn = tf::orient2d(axis, a, b, c);
        if (turn == 0) continue;
        return tf::orient2d(axis, a, b, q) == turn && tf::orient2d(axis, b, c, q) == turn &&
               tf::orient2d(axis, c, a, q) == turn;
    }
    return false;
}

/// All planes of three points with nothing above; of the points in each those that are not within
/// a segment or triangle of others. O(n^4) and worse.
std::set<corner_set> corners_by_brute_force(const points& all) {
    points p;
    corner_set seen;
    for (const tf::point3& q : all)
        if (seen.insert(key(q)).second) p.push_back(q);
    std::set<corner_set> sides;
    for (const tf::point3& a : p)
        for (const tf::point3& b : p)
            for (const tf::point3& c : p) {
                if (key(a) > key(b) || key(a) > key(c) || tf::collinear(a, b, c)) continue;
                points in_plane;
                bool outermost = true;
                for (const tf::point3& q : p) {
                    const int side = tf::orient3d(a, b, c, q);
                    outermost = outermost && side <= 0;
                    if (!outermost) break;
                    if (side == 0) in_plane.push_back(q);
                }
                if (!outermost) continue;
                corner_set corners;
                for (const tf::point3& q : in_plane) {
                    bool extreme = true;
                    for (const tf::point3& d : in_plane)
                        for (const tf::point3& e : in_plane) {
                            if (!extreme || d == e) continue;
                            if (between_points(q, d, e)) extreme = false;
                            for (const tf::point3& f : in_plane)
                                if (strictly_in_triangle(q, d, e, f)) extreme = false;
                        }
                    if (extreme) corners.insert(key(q));
                }
                sides.insert(corners);
            }
    return sides;
}

points lattice_points(test::random& source, std::size_t count, std::size_t side) {
    const auto whole = [&] { return static_cast<double>(source.below(side)); };
    points p;
    for (std::size_t i = 0; i < count; ++i) p.push_back({whole(), whole(), whole()});
    return p;
}

points random_points(test::random& source, std::size_t count) {
    points p;
    for (std::size_t i = 0; i < count; ++i)
        p.push_back({source.in(-1, 1), source.in(-1, 1), source.in(-1, 1)});
    return p;
}

}  // namespace

TEST_CASE("convex hull: a box has six sides of two triangles, measured exactly") {
    const tf::mesh box = test::box(2, 3, 4);
    const auto hull = tf::convex_hull(box.points);
    check_operand(box.points, hull);
    REQUIRE(hull.sides.size() == 6);
    std::multiset<double> areas;
    for (const tf::hull_side& side : hull.sides) {
        areas.insert(side.area);
        CHECK(side.face_count == 2);
        CHECK(hull.corners_of(side, box.points).size() == 4);
        const auto& n = side.normal;
        CHECK(std::abs(n.x) + std::abs(n.y) + std::abs(n.z) == 1.0);
        for (std::size_t k = 0; k < 3; ++k) {
            const double length = 2.0 + static_cast<double>(k);
            const double expected = n[k] == 0.0 ? length / 2 : n[k] > 0.0 ? length : 0.0;
            CHECK(side.center[k] == doctest::Approx(expected).epsilon(1e-15));
        }
    }
    CHECK(areas == std::multiset<double>{6, 6, 8, 8, 12, 12});
}

TEST_CASE("convex hull: of few dimensions, equal points, one point and none") {
    CHECK(tf::convex_hull({}).dimension == -1);
    const points one{{1, 2, 3}};
    CHECK(tf::convex_hull(one).dimension == 0);
    const points same(5, {1, 2, 3});
    CHECK(tf::convex_hull(same).dimension == 0);
    const points line{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {2, 2, 2}, {0, 0, 0}};
    CHECK(tf::convex_hull(line).dimension == 1);
    CHECK(tf::convex_hull(line).faces.empty());
    const points almost{{0, 0, 0}, {1, 1, 1}, {3, 3, 3 + 0x1p-51}, {2, 2, 2}};
    const auto flat = tf::convex_hull(almost);
    CHECK(flat.dimension == 2);
    CHECK(flat.sides.size() == 2);
    for (const tf::hull_side& side : flat.sides)  // the normal of so thin a sliver is still right
        CHECK(std::abs(side.normal.x + side.normal.y) < 1e-15);
    const points bump{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0x1p-1074}, {0.5, 0.5, 0}};
    CHECK(tf::convex_hull(bump).dimension == 3);
    check_operand(bump, tf::convex_hull(bump));
}

TEST_CASE("convex hull: points in a plane have two sides of the same corners") {
    test::random source(4);
    for (int round = 0; round < 15; ++round) {
        points p = lattice_points(source, 3 + source.below(12), 4);
        for (tf::point3& q : p) q = {q.x + q.y, q.x - q.y, 2 * q.x + 3 * q.y};
        const auto hull = tf::convex_hull(p);
        if (hull.dimension < 2) continue;
        REQUIRE(hull.dimension == 2);
        REQUIRE(hull.sides.size() == 2);
        const auto truth = corners_by_brute_force(p);
        CHECK(truth.size() == 1);
        for (const tf::hull_side& side : hull.sides) {
            corner_set corners;
            for (const std::uint32_t i : hull.corners_of(side, p)) corners.insert(key(p[i]));
            CHECK(truth.contains(corners));
        }
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(hull.sides[0].normal[k] == -hull.sides[1].normal[k]);
    }
}

TEST_CASE("convex hull agrees with all planes of three points, on random and lattice points") {
    test::random source(1);
    for (int round = 0; round < 40; ++round) {
        CAPTURE(round);
        const bool lattice = round % 2 == 0;
        const points p = lattice ? lattice_points(source, 4 + source.below(16), 2 + source.below(4))
                                 : random_points(source, 4 + source.below(14));
        const auto hull = tf::convex_hull(p);
        if (hull.dimension < 3) continue;
        check_operand(p, hull);
        CHECK(corners_by_hull(p, hull) == corners_by_brute_force(p));
        // of equal points the first
        for (const tf::face& f : hull.faces)
            for (const std::uint32_t i : f)
                CHECK(std::find(p.begin(), p.end(), p[i]) - p.begin() ==
                      static_cast<std::ptrdiff_t>(i));
    }
}

TEST_CASE("convex hull: many points in planes, on lines, on spheres, far away, large and small") {
    test::random source(2);
    points faces_of_cube;  // most hull faces are degenerate cases
    for (int i = 0; i < 600; ++i) {
        tf::point3 q{source.in(-1, 1), source.in(-1, 1), source.in(-1, 1)};
        q[source.below(3)] = source.below(2) != 0 ? 1.0 : -1.0;
        if (i % 3 == 0) q[source.below(3)] = 1.0;
        faces_of_cube.push_back(q);
    }
    points sphere = test::ball(3, 1.0).points;
    points grid = lattice_points(source, 800, 12);
    points far = random_points(source, 300);
    for (tf::point3& q : far) q = {q.x + 1e9, q.y - 1e9, q.z + 1e9};
    points cluster = random_points(source, 200);
    for (std::size_t i = 0; i < 190; ++i)
        cluster[i] = {cluster[i].x * 1e-200, cluster[i].y * 1e-12, cluster[i].z};
    for (const points* p : {&faces_of_cube, &sphere, &grid, &far, &cluster}) {
        const auto hull = tf::convex_hull(*p);
        check_operand(*p, hull);
        for (const double scale : {0x1p-900, 0x1p900}) {
            if (p == &cluster) continue;  // would be rounded
            points other = *p;
            for (tf::point3& q : other) q = {q.x * scale, q.y * scale, q.z * scale};
            const auto scaled = tf::convex_hull(other);
            CHECK(scaled.faces == hull.faces);
            for (std::size_t s = 0; s < hull.sides.size(); ++s)
                CHECK(scaled.sides[s].normal == hull.sides[s].normal);
        }
    }
    CHECK(tf::convex_hull(grid).sides.size() < 200);
}

TEST_CASE("convex hull: the order of the points does not matter to the sides") {
    test::random source(3);
    for (int round = 0; round < 20; ++round) {
        points p = lattice_points(source, 60, 6);
        const auto before = corners_by_hull(p, tf::convex_hull(p));
        source.shuffle(p);
        CHECK(corners_by_hull(p, tf::convex_hull(p)) == before);
    }
}

TEST_CASE("convex hull: the point that is not finite is named") {
    points p(4);
    p[2].y = std::numeric_limits<double>::infinity();
    CHECK_THROWS_WITH_AS(static_cast<void>(tf::convex_hull(p)), doctest::Contains("point 2"),
                         std::invalid_argument);
}
