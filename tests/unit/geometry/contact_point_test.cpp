#include "support/reference_intersection.hpp"
#include "support/stress_families.hpp"
#include <libmesh/geometry/contact_point.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace {

using tf::approximate_point;
using tf::feature_pair;
using tf::intersect;
using tf::point3;
using tf::triangle3;
using tf::triangle_contact;
using tf::test::integral;
using enum tf::triangle_feature;

const triangle3 half_square{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};

bool within_box(const point3& p, const triangle3& t) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
        if (!(low <= p[axis] && p[axis] <= high)) return false;
    }
    return true;
}

triangle3 scaled(const triangle3& t, double factor) {
    triangle3 result;
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = {t[i].x * factor, t[i].y * factor, t[i].z * factor};
    return result;
}

triangle3 small_triangle(tf::test::random_source& random) {
    triangle3 t;
    for (point3& p : t) p = {random.whole(0, 3), random.whole(0, 3), random.whole(0, 3)};
    return t;
}

}  // namespace

TEST_CASE("a corner comes out bit for bit, that of the first triangle where both have one") {
    const triangle3 signed_zero{{{-0.0, 0.1, 1e-310}, {1, 0, 0}, {0, 1, 0}}};
    const triangle3 plain{{{0.0, 0.1, 1e-310}, {0, 0, 5}, {0, 5, 5}}};
    CHECK(std::signbit(approximate_point(signed_zero, plain, {v0, v0}).x));
    CHECK_FALSE(std::signbit(approximate_point(plain, signed_zero, {v0, v0}).x));
    CHECK(std::signbit(approximate_point(plain, signed_zero, {interior, v0}).x));
    CHECK(approximate_point(plain, signed_zero, {e2, v0}) == signed_zero[0]);
}

TEST_CASE("an edge through an interior and two edges that cross have the point one expects") {
    const triangle3 blade{{{1, -1, -1}, {1, 1, -1}, {1, 0, 1}}};
    CHECK(approximate_point(half_square, blade, {e0, interior}) == point3{1, 0, 0});
    CHECK(approximate_point(half_square, blade, {interior, e1}) == point3{1, 0.5, 0});
    CHECK(approximate_point(blade, half_square, {e1, interior}) == point3{1, 0.5, 0});
    const triangle3 star{{{3, 3, 0}, {-1, 3, 0}, {3, -1, 0}}};
    CHECK(approximate_point(half_square, star, {e0, e1}) == point3{2, 0, 0});
    CHECK(approximate_point(half_square, star, {e1, e0}) == point3{1, 3, 0});
}

TEST_CASE("on small lattices the point is right to a few units in the last place") {
    tf::test::random_source random(1);
    int constructed = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        CAPTURE(trial);
        const triangle3 a = small_triangle(random);
        const triangle3 b = small_triangle(random);
        const tf::test::reference_intersection<std::int64_t> reference(integral(a), integral(b));
        for (std::size_t i = 0; i < reference.points().size(); ++i) {
            const feature_pair end = reference.answer().ends[i];
            const auto& exact = reference.points()[i];
            const point3 p = approximate_point(a, b, end);
            constructed += end.on_a > v2 && end.on_b > v2;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double expected =
                    static_cast<double>(exact.x[axis]) / static_cast<double>(exact.w);
                REQUIRE(std::abs(p[axis] - expected) <= 3 * 0x1p-52);  // edges are up to 3 long
            }
        }
    }
    CHECK(constructed > 5000);
}

TEST_CASE("the point is finite and inside both boxes whatever the triangles") {
    for (std::size_t f = 0; f < tf::test::stress_family_count; ++f) {
        CAPTURE(f);
        tf::test::stress_stream stream(static_cast<tf::test::stress_family>(f), 11);
        for (int trial = 0; trial < 1000; ++trial) {
            CAPTURE(trial);
            const auto [a, b] = stream.next();
            const triangle_contact found = intersect(a, b);
            for (std::size_t i = 0; i < found.count; ++i) {
                const point3 p = approximate_point(a, b, found.ends[i]);
                REQUIRE(within_box(p, a));
                REQUIRE(within_box(p, b));
            }
        }
    }
}

TEST_CASE("a power of two scales the point, up to the largest doubles and down to small ones") {
    tf::test::random_source random(2);
    for (int trial = 0; trial < 2000; ++trial) {
        const triangle3 a = small_triangle(random);
        const triangle3 b = small_triangle(random);
        const triangle_contact found = intersect(a, b);
        for (std::size_t i = 0; i < found.count; ++i)
            for (const double factor : {0x1p-960, 0x1p-700, -0x1p-3, 0x1p900, 0x1p1022}) {
                CAPTURE(factor);
                const point3 p = approximate_point(a, b, found.ends[i]);
                const point3 q =
                    approximate_point(scaled(a, factor), scaled(b, factor), found.ends[i]);
                REQUIRE(q == point3{p.x * factor, p.y * factor, p.z * factor});
            }
    }
}
