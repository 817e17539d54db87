#include <libmesh/exact/plane_predicates.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace {

using tf::point3;

/// A lattice point with coordinates from -3 to 3, times `scale`.
point3 small(test::random& random, double scale = 1.0) {
    const auto x = [&] { return (static_cast<double>(random.below(7)) - 3.0) * scale; };
    return {x(), x(), x()};
}

point3 sum(const point3& a, const point3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
point3 times(const point3& a, double f) { return {a.x * f, a.y * f, a.z * f}; }

tf::cutting_plane times(const tf::cutting_plane& p, double f) {
    return {times(p.at, f), times(p.u_from, f), times(p.u_to, f), times(p.v_from, f),
            times(p.v_to, f)};
}

/// A plane of lattice points with the direction on its positive side, or none in a few tries.
bool any_plane(test::random& random, const point3& d, tf::cutting_plane& plane) {
    for (int i = 0; i < 20; ++i) {
        plane = {small(random), small(random), small(random), small(random), small(random)};
        const point3 u{plane.u_to.x - plane.u_from.x, plane.u_to.y - plane.u_from.y,
                       plane.u_to.z - plane.u_from.z};
        const point3 v{plane.v_to.x - plane.v_from.x, plane.v_to.y - plane.v_from.y,
                       plane.v_to.z - plane.v_from.z};
        const int side = tf::direction_side({}, u, v, d);
        if (side < 0) {
            std::swap(plane.u_from, plane.v_from);
            std::swap(plane.u_to, plane.v_to);
        }
        if (side != 0) return true;
    }
    return false;
}

const std::array scales = {1.0, 0x1p-1070, 0x1p-500, 0x1p+500, 0x1p+1000};

TEST_CASE("direction_side: a direction is what leads from one point to another, but exactly") {
    test::random random(1);
    for (int i = 0; i < 20000; ++i) {
        const double scale = scales[random.below(scales.size())];
        const point3 a = small(random, scale), b = small(random, scale), c = small(random, scale);
        const point3 d = small(random, scale);
        const int side = tf::direction_side(a, b, c, d);
        REQUIRE(side == tf::orient3d(a, b, c, sum(a, d)));
        CHECK(tf::direction_side(b, c, a, d) == side);
        CHECK(tf::direction_side(b, a, c, d) == -side);
        CHECK(tf::direction_side(a, c, b, d) == -side);
        CHECK(tf::direction_side(a, b, c, times(d, -1.0)) == -side);
    }
    // origin + direction rounds to a point of the plane z = 1; the direction does climb.
    const point3 a{0, 0, 1}, b{1, 0, 1}, c{0, 1, 1};
    CHECK(tf::direction_side(a, b, c, {5, 7, 0x1p-60}) == 1);
    CHECK(tf::direction_side(a, b, c, {5, 7, -0x1p-1074}) == -1);
    CHECK(tf::direction_side(a, b, c, {5, 7, -0.0}) == 0);
}

TEST_CASE("line_side: agrees with orient2d where origin + direction is exact") {
    test::random random(2);
    for (int i = 0; i < 20000; ++i) {
        const double scale = scales[random.below(scales.size())];
        const point3 o = small(random, scale), d = small(random, scale), p = small(random, scale);
        for (const int axis : {0, 1, 2}) {
            const int side = tf::line_side(axis, o, d, p);
            REQUIRE(side == tf::orient2d(axis, o, sum(o, d), p));
            CHECK(tf::line_side(axis, o, times(d, -1.0), p) == -side);
        }
    }
    CHECK(tf::line_side(2, {0, 0, 0}, {1, 0x1p-80, 0}, {1, 0x1p-80, 0}) == 0);
    CHECK(tf::line_side(2, {0, 0, 0}, {1, 0x1p-80, 0}, {1, 0x1.8p-80, 0}) == 1);
}

TEST_CASE("cuts: compare_cut and compare_cuts order what cut_parameter computes") {
    test::random random(3);
    std::array<int, 3> seen{};
    for (int i = 0; i < 20000; ++i) {
        const point3 o = small(random), d = small(random);
        tf::cutting_plane p{}, q{};
        if (!any_plane(random, d, p) || !any_plane(random, d, q)) continue;
        // The parameters are quotients of whole numbers below 2000: equal, or far apart.
        const double t = tf::cut_parameter(o, d, p);
        const double s = tf::cut_parameter(o, d, q);
        const int order = std::abs(t - s) < 1e-9 ? 0 : t < s ? -1 : 1;
        REQUIRE(tf::compare_cuts(o, d, p, q) == order);
        CHECK(tf::compare_cuts(o, d, q, p) == -order);
        CHECK(tf::compare_cuts(o, d, p, p) == 0);
        ++seen[static_cast<std::size_t>(order + 1)];
        const double rounded = std::round(t);
        const bool whole = std::abs(t - rounded) < 1e-9;
        CHECK(tf::compare_cut(o, d, p, rounded) == (whole ? 0 : t < rounded ? -1 : 1));
        CHECK(tf::compare_cut(o, d, p, std::nextafter(rounded, 1e9)) ==
              (t > rounded && !whole ? 1 : -1));
        for (const double scale : {0x1p-1000, 0x1p+900})
            for (const double length : {1.0, 0x1p-60}) {
                const point3 so = times(o, scale), sd = times(d, scale * length);
                CHECK(tf::compare_cuts(so, sd, times(p, scale), times(q, scale)) == order);
                CHECK(tf::compare_cut(so, sd, times(p, scale), rounded / length) ==
                      tf::compare_cut(o, d, p, rounded));
                CHECK(tf::cut_parameter(so, sd, times(p, scale)) * length ==
                      doctest::Approx(t).epsilon(0x1p-39));
            }
    }
    for (const int count : seen) CHECK(count > 50);
}

TEST_CASE("cut_parameter: nearly parallel planes lose no digits") {
    // z = e x from (0, 0, 1) downhill by 1 in 2^30: meets at t = 1 / (2^-30 + e), where double
    // arithmetic on the normal alone would have lost half of the digits.
    const point3 o{0x1p20, 0x1p20, 1};
    const point3 d{1, 1, -0x1p-30};
    const tf::cutting_plane plane{{0x1p20, 0x1p20, 0}, {}, {1, 1, 0x1p-45}, {}, {-1, 1, 0}};
    const double t = tf::cut_parameter(o, d, plane);
    const double expected = 1.0 / (0x1p-30 + 0x1p-45);
    CHECK(std::abs(t - expected) <= 0x1p-40 * expected);
    CHECK(tf::cut_parameter({0, 0, 3}, {0, 0, 1}, {{0, 0, 3}, {}, {1, 0, 0}, {}, {0, 1, 0}}) ==
          0.0);
    CHECK(tf::cut_parameter({0, 0, 0}, {0, 0, 0x1p-1000},
                            {{0, 0, 0x1p1000}, {}, {1, 0, 0}, {}, {0, 1, 0}}) ==
          std::numeric_limits<double>::infinity());
}

TEST_CASE("predicates about lines: the filter decides plain calls, integers the rest") {
    tf::predicate_counters plain, flat;
    const point3 a{0.1, 0.2, 0.3}, b{1.7, 0.4, 0.9}, c{0.3, 2.1, 0.8}, d{0.3, 0.1, 5.0};
    CHECK(tf::direction_side(a, b, c, d, &plain) == 1);
    CHECK(plain.calls == 1);
    CHECK(plain.undecided == 0);
    CHECK(tf::direction_side({1, 1, 1}, {2, 3, 4}, {4, 3, 2}, {4, 4, 4}, &flat) == 0);
    CHECK(flat.undecided == 1);
    CHECK(flat.by_width[0] == 1);
}

}  // namespace
