#include <libmesh/geometry/closest_point.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace {

double squared_between(const tf::point3& a, const tf::point3& b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sum;
}

const tf::triangle3 right_angled{{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}};

}  // namespace

TEST_CASE("closest point: every feature of a triangle is nearest to what lies beyond it") {
    using tf::point3;
    const std::array<std::array<point3, 2>, 9> expected{{
        {{{1, 1, 5}, {1, 1, 0}}},   // above the inside
        {{{1, 1, 0}, {1, 1, 0}}},   // in it
        {{{2, -1, 0}, {2, 0, 0}}},  // edges
        {{{-2, 1, 1}, {0, 1, 0}}},
        {{{5, 5.5, 0}, {2, 1.5, 0}}},
        {{{-1, -1, 2}, {0, 0, 0}}},  // corners
        {{{9, -1, 0}, {4, 0, 0}}},
        {{{-1, 9, 3}, {0, 3, 0}}},
        {{{4, 0, 0}, {4, 0, 0}}},
    }};
    for (const auto& [query, nearest] : expected) {
        tf::triangle3 t = right_angled;
        std::sort(t.begin(), t.end(), [](const point3& a, const point3& b) { return a.x < b.x; });
        for (int turn = 0; turn < 6; ++turn) {
            const auto found = tf::closest_point(t, query);
            for (std::size_t k = 0; k < 3; ++k)
                CHECK(found.point[k] == doctest::Approx(nearest[k]).epsilon(1e-14));
            CHECK(found.squared_distance ==
                  doctest::Approx(squared_between(query, nearest)).epsilon(1e-14));
            std::rotate(t.begin(), t.begin() + 1, t.end());
            if (turn == 2) std::swap(t[0], t[1]);
        }
    }
}

TEST_CASE("closest point: a degenerate triangle is the segment or point it spans") {
    const tf::triangle3 segment{{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}};
    CHECK(tf::closest_point(segment, {4, 4, 4}).squared_distance == doctest::Approx(3.0));
    CHECK(tf::closest_point(segment, {2, 2, 0}).squared_distance == doctest::Approx(8.0 / 3.0));
    CHECK(tf::closest_point({{{0, 0, 0}, {0, 0, 0}, {2, 0, 0}}}, {1, 1, 0}).point ==
          tf::point3{1, 0, 0});
    const tf::triangle3 point{{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}};
    CHECK(tf::closest_point(point, {1, 2, 5}).point == tf::point3{1, 2, 3});
    CHECK(tf::closest_point(point, {1, 2, 5}).squared_distance == 4.0);
}

TEST_CASE("closest point: no point of the triangle is nearer") {
    test::random source(1);
    for (int round = 0; round < 300; ++round) {
        tf::triangle3 t;
        for (tf::point3& corner : t) corner = {source.unit(), source.unit(), source.unit()};
        if (round % 3 == 0)  // a sliver
            for (std::size_t k = 0; k < 3; ++k)
                t[2][k] = 0.3 * t[0][k] + 0.7 * t[1][k] + 1e-9 * source.unit();
        const tf::point3 p{source.in(-1, 2), source.in(-1, 2), source.in(-1, 2)};
        const auto found = tf::closest_point(t, p);
        CHECK(std::sqrt(squared_between(found.point, p)) ==
              doctest::Approx(std::sqrt(found.squared_distance)).epsilon(1e-12));
        for (int i = 0; i <= 10; ++i)
            for (int j = 0; i + j <= 10; ++j) {
                tf::point3 at;
                for (std::size_t k = 0; k < 3; ++k)
                    at[k] = 0.1 * i * t[0][k] + 0.1 * j * t[1][k] + 0.1 * (10 - i - j) * t[2][k];
                REQUIRE(std::sqrt(squared_between(at, p)) >
                        std::sqrt(found.squared_distance) - 1e-14);
            }
    }
}
