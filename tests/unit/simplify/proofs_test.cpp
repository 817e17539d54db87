/// \file
/// What proofs of distance are made of, against samples in long double: bounds are never too low.

#include <libmesh/geometry/closest_point.hpp>
#include <libmesh/simplify/covering.hpp>
#include <libmesh/simplify/seen_along.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace {

using namespace treeform::detail::simplify;  // NOLINT: whose tests these are
using long_point = std::array<long double, 3>;

long_point point_at(const tf::triangle3& t, long double a, long double b) {
    long_point p{};
    for (std::size_t k = 0; k < 3; ++k)
        p[k] = t[0][k] + a * (static_cast<long double>(t[1][k]) - t[0][k]) +
               b * (static_cast<long double>(t[2][k]) - t[0][k]);
    return p;
}

long double apart(const long_point& p, const long_point& q) {
    return std::sqrt((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) +
                     (p[2] - q[2]) * (p[2] - q[2]));
}

/// Distance of a point from a segment.
long double distance_to(const long_point& from, const long_point& to, const long_point& p) {
    long double along = 0, length = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        along += (to[k] - from[k]) * (p[k] - from[k]);
        length += (to[k] - from[k]) * (to[k] - from[k]);
    }
    const long double share = length > 0 ? std::clamp(along / length, 0.0L, 1.0L) : 0;
    long_point foot{};
    for (std::size_t k = 0; k < 3; ++k) foot[k] = from[k] + share * (to[k] - from[k]);
    return apart(p, foot);
}

/// Distance of a point from a triangle: the least of those from segments across it, a convex
/// function.
long double distance_to(const tf::triangle3& t, const long_point& p) {
    const auto at = [&](long double a) {
        return distance_to(point_at(t, a, 0), point_at(t, a, 1 - a), p);
    };
    long double low = 0, high = 1;
    for (int i = 0; i < 110; ++i) {
        const long double a = low + (high - low) / 3, b = high - (high - low) / 3;
        (at(a) < at(b) ? high : low) = at(a) < at(b) ? b : a;
    }
    return std::min({at(0), at((low + high) / 2), at(1)});
}

/// Any, flat, thin, or all in one plane; all `far` from the origin.
tf::triangle3 some_triangle(test::random& source, std::size_t kind, double size, double far) {
    tf::triangle3 t;
    for (tf::point3& p : t) {
        p = {source.in(-1, 1), source.in(-1, 1), kind == 2 ? 0.0 : 0.3 * source.in(-1, 1)};
        if (kind == 1) p.y = 1e-6 * p.y + 0.5 * p.x;
        p = {far + size * p.x, size * p.y, far + size * p.z};
    }
    return t;
}

}  // namespace

TEST_CASE("The distance alone is that of the closest point, to the bit") {
    for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
        test::random source(seed);
        const tf::triangle3 t = some_triangle(source, seed % 3, 1, seed % 2 == 0 ? 0.0 : 1e6);
        const tf::point3 p{t[0].x + source.in(-2, 2), source.in(-2, 2), t[0].z + source.in(-1, 1)};
        const treeform::detail::geometry::based_triangle based(t);
        REQUIRE(treeform::detail::geometry::squared_distance(based, p) ==
                tf::closest_point(t, p).squared_distance);
    }
}

TEST_CASE("What is covered is no further away than was said") {
    std::size_t proven = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const double far = seed % 4 == 3 ? 1e6 : 0.0, distance = source.in(0.05, 0.5);
        const tf::triangle3 t = some_triangle(source, seed % 3, 1, far);
        std::vector<tf::triangle3> others;
        std::vector<target> by;
        for (int i = 0; i < 12; ++i) {
            others.push_back(some_triangle(source, (seed / 3) % 3, 1.5, far));
            by.emplace_back(others.back());
        }
        covering one(far + 2);
        if (!one.cover(t, by, distance)) continue;
        ++proven;
        double at_most = 0.0;
        for (const covering::use& use : one.used()) at_most = std::max(at_most, use.at_most);
        CHECK(at_most <= distance);
        for (int i = 0; i < 12; ++i) {
            const double a = i < 3 ? i % 2 : source.in(0, 1), b = i < 3 ? i / 2 : source.in(0, 1);
            const long_point p = point_at(t, a, (1 - a) * b);
            long double least = 1e9L;
            for (const covering::use& use : one.used())
                least = std::min(least, distance_to(others[use.number], p));
            CHECK(least <= static_cast<long double>(at_most));
        }
    }
    CHECK(proven > 500);
}

TEST_CASE("What is further away somewhere, if only at a corner, is not covered") {
    const tf::triangle3 t{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    covering one(2.0);
    for (const double high : {0.25, 0.5}) {
        const std::vector<target> by{target({{{-1, -1, high}, {3, -1, high}, {-1, 3, high}}})};
        CHECK(one.cover(t, by, high * (1 + 1e-12)));
        CHECK_FALSE(one.cover(t, by, high * (1 - 1e-12)));
        CHECK_FALSE(one.cover(t, by, high));  // not beyond doubt
        const std::vector<target> less{
            target({{{-1, -1, high}, {1.5, -1, high}, {-1, 1.5, high}}})};
        CHECK_FALSE(one.cover(t, less, high * (1 + 1e-12)));
    }
    CHECK_FALSE(one.cover(t, {}, 10.0));
    const std::vector<target> halves{target({{{0, 0, 0}, {0.5, 0.5, 0}, {0, 1, 0}}}),
                                     target({{{0, 0, 0}, {1, 0, 0}, {0.5, 0.5, 0}}})};
    CHECK(one.cover(t, halves, 1e-12));
    CHECK(one.used().size() == 2);
}

TEST_CASE("Heights of triangles that cover each other differ by no more than the gap") {
    std::size_t common = 0;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const double far = seed % 4 == 3 ? 1e6 : 0.0;
        const tf::triangle3 a = some_triangle(source, seed % 3, 1, far);
        const tf::triangle3 b = some_triangle(source, (seed / 3) % 3, source.in(0.1, 3), far);
        const view_along view({source.in(-0.2, 0.2), source.in(-0.2, 0.2), 1}, a[0]);
        const seen_triangle seen_a = view.see(a), seen_b = view.see(b);
        if (!view.faces_eye(a, seen_a) || !view.faces_eye(b, seen_b)) continue;
        const std::optional<double> gap = gap_between(seen_a, seen_b);
        // Of places of `a` in the view, those in `b`, and how high both are there.
        for (int i = 0; i < 20; ++i) {
            const double s = i < 3 ? i % 2 : source.in(0, 1), r = i < 3 ? i / 2 : source.in(0, 1);
            const auto seen_at = [](const seen_triangle& t, long double x, long double y) {
                long_point p{};
                for (std::size_t k = 0; k < 3; ++k)
                    p[k] = t.at[0][k] + x * (static_cast<long double>(t.at[1][k]) - t.at[0][k]) +
                           y * (static_cast<long double>(t.at[2][k]) - t.at[0][k]);
                return p;
            };
            const long_point p = seen_at(seen_a, s, (1 - s) * r);
            const auto& q = seen_b.at;
            const long double ux = q[1].x - static_cast<long double>(q[0].x),
                              uy = q[1].y - static_cast<long double>(q[0].y),
                              vx = q[2].x - static_cast<long double>(q[0].x),
                              vy = q[2].y - static_cast<long double>(q[0].y), x = p[0] - q[0].x,
                              y = p[1] - q[0].y, all = ux * vy - uy * vx;
            const long double share_1 = (x * vy - y * vx) / all, share_2 = (ux * y - uy * x) / all;
            if (share_1 < 0 || share_2 < 0 || share_1 + share_2 > 1) continue;
            ++common;
            REQUIRE(gap);
            CHECK(std::abs(seen_at(seen_b, share_1, share_2)[2] - p[2]) <=
                  static_cast<long double>(*gap));
        }
    }
    CHECK(common > 1000);
}
