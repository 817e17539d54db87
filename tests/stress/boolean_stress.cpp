/// \file
/// Set operations on pairs that are hard to get right, with their volumes in rationals.
///
/// TREEFORM_STRESS_COUNT sets the pairs of each family (default 40), TREEFORM_STRESS_SEED the seed.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <gmpxx.h>
#include <support/rational_volume.hpp>
#include <support/settings.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace {

using test::cross;
using test::dot;
using test::meeting;
using test::minus;
using test::rational;
using test::rational_point;
using test::under;
using test::volume_of;
using plane = test::rational_plane;

std::size_t pairs_of_family() { return test::stress_count(40); }

/// Exact volumes of the union and the intersection of two operands.
struct two_volumes {
    mpq_class both, either;
};

two_volumes arranged_volumes(const tf::mesh& a, const tf::mesh& b) {
    const std::array operands{a, b};
    const test::exact_arrangement arranged(operands);
    REQUIRE(arranged.closed());
    const auto both = tf::boolean_expression::intersection_of(2);
    const auto either = tf::boolean_expression::union_of(2);
    two_volumes sums{0, 0};
    for (std::size_t f = 0; f < arranged.cut().faces.size(); ++f) {
        const int of_both = arranged.sign(f, both), of_either = arranged.sign(f, either);
        if (of_both == 0 && of_either == 0) continue;
        const mpq_class part = arranged.under_face(f);
        sums.both += of_both * part;
        sums.either += of_either * part;
    }
    sums.both /= 6;
    sums.either /= 6;
    return sums;
}

/// The part of a convex polygon behind a plane.
std::vector<rational_point> behind(const std::vector<rational_point>& polygon, const plane& of) {
    std::vector<rational_point> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const rational_point& p = polygon[i];
        const rational_point& q = polygon[(i + 1) % polygon.size()];
        const int at_p = sgn(of.side(p)), at_q = sgn(of.side(q));
        if (at_p <= 0) kept.push_back(p);
        if (at_p * at_q < 0) kept.push_back(meeting(p, q, of));
    }
    return kept;
}

std::vector<plane> planes_of(const tf::mesh& mesh) {
    std::vector<plane> planes;
    for (const tf::face& f : mesh.faces)
        planes.emplace_back(rational(mesh.points[f[0]]), rational(mesh.points[f[1]]),
                            rational(mesh.points[f[2]]));
    return planes;
}

/// Six times the volume under the faces of `mesh` that lie in the convex solid of `planes`; in the
/// planes themselves only when `closed`.
mpq_class under_faces_in(const tf::mesh& mesh, const std::vector<plane>& planes, bool closed) {
    mpq_class sum = 0;
    for (const tf::face& f : mesh.faces) {
        std::vector<rational_point> polygon;
        for (const std::uint32_t c : f) polygon.push_back(rational(mesh.points[c]));
        const std::vector<rational_point> whole = polygon;
        const plane own(whole[0], whole[1], whole[2]);
        bool counts = true;
        for (const plane& p : planes) {
            const bool same = p.side(whole[0]) == 0 && p.side(whole[1]) == 0 &&
                              p.side(whole[2]) == 0 && dot(p.normal, own.normal) > 0;
            counts = counts && (closed || !same);
            polygon = behind(polygon, p);
        }
        if (!counts) continue;
        for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
            sum += under(polygon[0], polygon[i], polygon[i + 1]);
    }
    return sum;
}

/// The volume of the intersection of two convex solids, without any arrangement.
mpq_class convex_intersection(const tf::mesh& a, const tf::mesh& b) {
    return mpq_class(
        (under_faces_in(a, planes_of(b), true) + under_faces_in(b, planes_of(a), false)) / 6);
}

/// What has been tried, and how often the rounded result was certified.
struct certified_results {
    std::size_t results = 0, certified = 0;
    ~certified_results() {
        CHECK(static_cast<double>(certified) >= 0.995 * static_cast<double>(results));
        MESSAGE(certified << " of " << results << " results certified in doubles");
    }
};

/// Checks a rounded result against its exact volume.
void check_result(const tf::boolean_result& result, const mpq_class& volume, double scale,
                  certified_results& counts) {
    ++counts.results;
    CHECK(result.certificate.open_count == 0);
    if (!result.certificate) return;
    ++counts.certified;
    CHECK(tf::self_intersections(result.mesh).pairs.empty());
    CHECK(!tf::find_open_edge(result.mesh));
    // Each of the points moves by max_move at most, and the area is bounded by the box's.
    const mpq_class off = abs(mpq_class(volume_of(result.mesh) - volume));
    CHECK(off.get_d() <= 64.0 * scale * scale * (result.certificate.max_displacement + 1e-300));
}

void check_pair(const tf::mesh& a, const tf::mesh& b, double scale, certified_results& counts,
                const std::function<mpq_class()>& truth = {}) {
    const mpq_class volume_a = volume_of(a), volume_b = volume_of(b);
    const two_volumes exact = arranged_volumes(a, b);
    CHECK(exact.both + exact.either == volume_a + volume_b);
    if (truth) CHECK(exact.both == truth());
    const std::array<tf::mesh_view, 2> views{a, b};
    check_result(tf::boolean(views, tf::boolean_expression::union_of(2)), exact.either, scale,
                 counts);
    check_result(tf::boolean(views, tf::boolean_expression::intersection_of(2)), exact.both, scale,
                 counts);
    check_result(tf::boolean(views, tf::boolean_expression::difference_of(2)),
                 volume_a - exact.both, scale, counts);
}

/// Turned about a random axis, in doubles.
tf::mesh turned(tf::mesh mesh, test::random& source, double angle) {
    double x = source.in(-1, 1), y = source.in(-1, 1), z = source.in(-1, 1);
    const double length = std::hypot(x, y, z);
    x /= length, y /= length, z /= length;
    const double c = std::cos(angle), s = std::sin(angle), d = 1.0 - c;
    for (tf::point3& p : mesh.points)
        p = {(c + x * x * d) * p.x + (x * y * d - z * s) * p.y + (x * z * d + y * s) * p.z,
             (y * x * d + z * s) * p.x + (c + y * y * d) * p.y + (y * z * d - x * s) * p.z,
             (z * x * d - y * s) * p.x + (z * y * d + x * s) * p.y + (c + z * z * d) * p.z};
    return mesh;
}

tf::mesh tetrahedron(std::array<tf::point3, 4> p) {
    const mpq_class volume =
        under(minus(rational(p[1]), rational(p[0])), minus(rational(p[2]), rational(p[0])),
              minus(rational(p[3]), rational(p[0])));
    if (volume < 0) std::swap(p[0], p[1]);
    return {{p.begin(), p.end()}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

std::uint64_t seed_of(std::uint64_t family) { return test::stress_seed() * 100 + family; }

}  // namespace

TEST_CASE("boxes at random angles have the volumes that clipping gives") {
    test::random source(seed_of(1));
    certified_results counts;
    for (std::size_t i = 0; i < pairs_of_family(); ++i) {
        CAPTURE(i);
        // A turned box is no longer exactly convex: tetrahedra of rounded points are.
        const auto solid = [&] {
            const tf::mesh box =
                test::moved(turned(test::box(1, 1, 1), source, source.in(0, 3)),
                            {source.in(-0.6, 0.6), source.in(-0.6, 0.6), source.in(-0.6, 0.6)});
            return tetrahedron({box.points[0], box.points[3], box.points[5], box.points[6]});
        };
        const tf::mesh a = solid(), b = solid();
        check_pair(a, b, 4.0, counts, [&] { return convex_intersection(a, b); });
        const tf::mesh c = test::moved(turned(test::box(1, 1, 1), source, source.in(0, 3)),
                                       {source.unit(), source.unit(), source.unit()});
        check_pair(test::box(1, 1, 1), c, 4.0, counts);
    }
}

TEST_CASE("tetrahedra that share a corner, an edge or a face are exact") {
    test::random source(seed_of(2));
    certified_results counts;
    for (std::size_t i = 0; i < pairs_of_family(); ++i) {
        CAPTURE(i);
        const bool whole = source.below(2) == 0;
        const auto coordinate = [&] {
            return whole ? static_cast<double>(source.below(7)) : source.in(-1, 1);
        };
        const auto point = [&] { return tf::point3{coordinate(), coordinate(), coordinate()}; };
        std::array<tf::point3, 4> p{point(), point(), point(), point()};
        std::array<tf::point3, 4> q{point(), point(), point(), point()};
        for (std::size_t k = 0; k < 1 + i % 3; ++k) q[k] = p[k];
        const tf::mesh a = tetrahedron(p), b = tetrahedron(q);
        if (volume_of(a) == 0 || volume_of(b) == 0) continue;
        check_pair(a, b, 8.0, counts, [&] { return convex_intersection(a, b); });
    }
}

TEST_CASE("boxes of whole corners, in all ways to touch, are exact") {
    test::random source(seed_of(3));
    certified_results counts;
    for (std::size_t i = 0; i < pairs_of_family(); ++i) {
        CAPTURE(i);
        const auto whole = [&](std::size_t n) { return static_cast<double>(source.below(n)); };
        const auto box = [&] {
            return test::moved(test::box(1 + whole(3), 1 + whole(3), 1 + whole(3)),
                               {whole(4), whole(4), whole(4)});
        };
        const tf::mesh a = box(), b = box();
        check_pair(a, b, 8.0, counts, [&] { return convex_intersection(a, b); });
    }
}

TEST_CASE("solids nearly on top of each other, turned or moved by less and less") {
    test::random source(seed_of(4));
    certified_results counts;
    const tf::mesh ball = test::ball(2, 1.0);
    tf::mesh slab = test::box(8, 8, 1);
    for (int exponent = 1; exponent <= 16; ++exponent) {
        CAPTURE(exponent);
        const double little = std::pow(10.0, -exponent);
        check_pair(slab, turned(slab, source, little), 16.0, counts);
        check_pair(ball, test::moved(ball, {little, 0, 0}), 4.0, counts);
    }
    tf::mesh next = ball;
    for (tf::point3& p : next.points) p.x = std::nextafter(p.x, 9.0);
    check_pair(ball, next, 4.0, counts);
    check_pair(ball, ball, 4.0, counts);
}

TEST_CASE("sizes from 1e-30 to 1e30 and offsets up to 1e9 change nothing") {
    test::random source(seed_of(5));
    certified_results counts;
    for (const int exponent : {-30, -20, -10, 10, 20, 30}) {
        CAPTURE(exponent);
        const double scale = std::pow(10.0, exponent);
        const tf::mesh a = test::scaled(test::ball(1, 1.0), scale);
        const tf::mesh b = test::scaled(
            test::moved(turned(test::box(1, 1, 1), source, 0.7), {0.1, 0.2, 0.3}), scale);
        check_pair(a, b, 4.0 * scale, counts);
    }
    for (const double offset : {1e3, 1e6, 1e9}) {
        CAPTURE(offset);
        const tf::point3 by{offset, -offset, 0.5 * offset};
        check_pair(test::moved(test::ball(1, 1.0), by),
                   test::moved(turned(test::box(1, 1, 1), source, 0.7), by), 4.0 * offset, counts);
    }
}

TEST_CASE("a Menger sponge has the volume of its definition") {
    // The cube without three square rods a side for each level.
    for (int level = 1; level <= 2; ++level) {
        CAPTURE(level);
        const double side = std::pow(3.0, level);
        std::vector<tf::mesh> solids{test::box(side, side, side)};
        for (int step = 1; step <= level; ++step) {
            const double hole = side / std::pow(3.0, step);
            for (double u = hole; u < side; u += 3.0 * hole)
                for (double v = hole; v < side; v += 3.0 * hole)
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        tf::mesh rod = test::box(hole, hole, side + 2.0);
                        for (tf::point3& p : rod.points) {
                            const std::array<double, 3> q{p.x + u, p.y + v, p.z - 1.0};
                            p = {q[axis], q[(axis + 1) % 3], q[(axis + 2) % 3]};
                        }
                        solids.push_back(std::move(rod));
                    }
        }
        const std::vector<tf::mesh_view> views(solids.begin(), solids.end());
        const auto result = tf::boolean(views, tf::boolean_expression::difference_of(views.size()));
        CHECK(result.certificate);
        CHECK(volume_of(result.mesh) ==
              mpq_class(static_cast<long>(std::lround(std::pow(20.0, level)))));
    }
}

TEST_CASE("wedges about one edge, in any number, are one solid") {
    test::random source(seed_of(6));
    certified_results counts;
    for (std::size_t i = 0; i < pairs_of_family() / 4 + 1; ++i) {
        CAPTURE(i);
        std::vector<tf::mesh> wedges;
        mpq_class sum = 0;
        const std::size_t count = 3 + source.below(9);
        for (std::size_t k = 0; k < count; ++k) {
            const double from = source.in(0, 6.28), to = from + source.in(0.1, 1.5);
            wedges.push_back(tetrahedron({tf::point3{0, 0, -1}, tf::point3{0, 0, 1},
                                          tf::point3{std::cos(from), std::sin(from), 0.1},
                                          tf::point3{std::cos(to), std::sin(to), -0.1}}));
            sum += volume_of(wedges.back());
        }
        const std::vector<tf::mesh_view> views(wedges.begin(), wedges.end());
        const auto all = tf::boolean(views, tf::boolean_expression::union_of(views.size()));
        ++counts.results;
        if (!all.certificate) continue;
        ++counts.certified;
        CHECK(volume_of(all.mesh).get_d() <= sum.get_d() * (1.0 + 1e-12));
        CHECK(!tf::find_open_edge(all.mesh));
    }
}

TEST_CASE("a chain of a hundred unions, each fed the last result, stays a solid") {
    test::random source(seed_of(7));
    tf::mesh so_far = test::box(1, 1, 1);
    std::vector<tf::mesh> all{so_far};
    for (int link = 0; link < 100; ++link) {
        CAPTURE(link);
        all.push_back(test::moved(turned(test::box(1, 0.5, 0.25), source, source.in(0, 3)),
                                  {source.in(-1, 1), source.in(-1, 1), source.in(-1, 1)}));
        const std::array<tf::mesh_view, 2> two{so_far, all.back()};
        tf::boolean_result next = tf::boolean(two, tf::boolean_expression::union_of(2));
        REQUIRE(next.certificate);
        so_far = std::move(next.mesh);
    }
    const std::vector<tf::mesh_view> views(all.begin(), all.end());
    const auto at_once = tf::boolean(views, tf::boolean_expression::union_of(views.size()));
    REQUIRE(at_once.certificate);
    CHECK(tf::signed_volume(so_far) ==
          doctest::Approx(tf::signed_volume(at_once.mesh)).epsilon(1e-12));
}
