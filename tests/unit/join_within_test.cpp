#include <libmesh/exact/predicates.hpp>
#include <libmesh/weld/join_within.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace {

using tf::find_points_within;
using tf::point3;

bool within(const point3& a, const point3& b, double distance) {
    return tf::compare_distance(a, b, {}, {distance, 0.0, 0.0}) <= 0;
}

/// The docstring as a quadratic loop.
tf::joined_points by_definition(const std::vector<point3>& points, double distance) {
    tf::joined_points result;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        std::uint32_t best = 0xffffffffU;
        for (std::uint32_t k = 0; k < result.first_of_new.size(); ++k) {
            const std::uint32_t kept = result.first_of_new[k];
            if (!within(points[i], points[kept], distance)) continue;
            if (best == 0xffffffffU || tf::compare_distance(points[i], points[kept], points[i],
                                                            points[result.first_of_new[best]]) < 0)
                best = k;
        }
        if (best == 0xffffffffU) {
            best = static_cast<std::uint32_t>(result.first_of_new.size());
            result.first_of_new.push_back(i);
        }
        result.new_of_old.push_back(best);
    }
    return result;
}

double unit_number(std::mt19937_64& engine) {
    return static_cast<double>(engine() >> 11) * 0x1p-53;
}

void check_definition(const std::vector<point3>& points, double distance) {
    const auto joined = find_points_within(points, distance);
    const auto expected = by_definition(points, distance);
    CHECK(joined.new_of_old == expected.new_of_old);
    CHECK(joined.first_of_new == expected.first_of_new);
}

}  // namespace

TEST_CASE("join_within: nothing comes of nothing") {
    CHECK(find_points_within({}, 1.0).new_of_old.empty());
}

TEST_CASE("join_within: the distance is inclusive") {
    const double gap = 0.25;
    const std::vector<point3> points{{0, 0, 0}, {gap, 0, 0}};
    CHECK(find_points_within(points, gap).first_of_new.size() == 1);
    CHECK(find_points_within(points, std::nextafter(gap, 0.0)).first_of_new.size() == 2);
    const std::vector<point3> diagonal{{0, 0, 0}, {3, 4, 12}};
    CHECK(find_points_within(diagonal, 13.0).first_of_new.size() == 1);
    CHECK(find_points_within(diagonal, std::nextafter(13.0, 0.0)).first_of_new.size() == 2);
}

TEST_CASE("join_within: zero joins equal coordinates only") {
    const std::vector<point3> points{{0.0, 1, 2}, {-0.0, 1, 2}, {5e-324, 1, 2}};
    const auto joined = find_points_within(points, 0.0);
    CHECK(joined.new_of_old == std::vector<std::uint32_t>{0, 0, 1});
}

TEST_CASE("join_within: a chain is not followed") {
    const std::vector<point3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    const auto joined = find_points_within(points, 1.0);
    CHECK(joined.new_of_old == std::vector<std::uint32_t>{0, 0, 1, 1});
}

TEST_CASE("join_within: a point goes to the nearest, the earlier of two as near") {
    const std::vector<point3> points{{0, 0, 0}, {3, 0, 0}, {2, 0, 0}, {1.5, 0, 0}};
    CHECK(find_points_within(points, 2.0).new_of_old == std::vector<std::uint32_t>{0, 1, 1, 0});
}

TEST_CASE("join_within: points that are not finite stay alone") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    const std::vector<point3> points{{nan, 0, 0}, {nan, 0, 0}, {inf, 0, 0},
                                     {inf, 0, 0}, {0, 0, 0},   {0, 0, 0}};
    CHECK(find_points_within(points, 1.0).new_of_old ==
          std::vector<std::uint32_t>{0, 1, 2, 3, 4, 4});
}

TEST_CASE("join_within: a distance that cannot be meant is refused") {
    const std::vector<point3> points{{0, 0, 0}};
    for (const double bad :
         {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
        CHECK_THROWS_AS(static_cast<void>(find_points_within(points, bad)), std::invalid_argument);
}

TEST_CASE("join_within: agrees with its definition on random points") {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        CAPTURE(seed);
        std::mt19937_64 engine(seed);
        std::vector<point3> points;
        for (int i = 0; i < 300; ++i)
            points.push_back({unit_number(engine), unit_number(engine), unit_number(engine) * 0.1});
        for (const double distance : {0.0, 0.01, 0.07, 0.5, 3.0})
            check_definition(points, distance);
    }
}

TEST_CASE("join_within: agrees with its definition on lattices, where distances tie") {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        CAPTURE(seed);
        std::mt19937_64 engine(seed);
        std::vector<point3> points;
        const auto coordinate = [&] { return static_cast<double>(engine() % 6) * 0.5 - 1.0; };
        for (int i = 0; i < 200; ++i) points.push_back({coordinate(), coordinate(), coordinate()});
        for (const double distance : {0.0, 0.5, 0.75, 1.0, 1.5}) check_definition(points, distance);
    }
}

TEST_CASE("join_within: scales from denormal to the largest double") {
    std::mt19937_64 engine(7);
    std::vector<point3> unit;
    for (int i = 0; i < 60; ++i)
        unit.push_back({unit_number(engine) - 0.5, unit_number(engine), unit_number(engine)});
    for (const int exponent : {-1060, -900, -300, 0, 300, 1000, 1023}) {
        CAPTURE(exponent);
        std::vector<point3> points;
        for (const point3& p : unit)
            points.push_back(
                {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)});
        check_definition(points, std::ldexp(0.25, exponent));
    }
    const double most = std::numeric_limits<double>::max();
    check_definition({{-most, 0, 0}, {most, 0, 0}, {0, 0, 0}, {most, 1, 0}}, most);
}

TEST_CASE("join_within: kept points are apart, and joining again changes nothing") {
    std::mt19937_64 engine(3);
    tf::mesh mesh;
    for (int i = 0; i < 500; ++i)
        mesh.points.push_back({unit_number(engine), unit_number(engine), 0.0});
    for (std::uint32_t i = 0; i + 2 < 500; i += 3) mesh.faces.push_back({i, i + 1, i + 2});
    const tf::mesh joined = tf::join_points_within(mesh, 0.05);
    CHECK(joined.faces.size() == mesh.faces.size());
    for (std::size_t i = 0; i < joined.points.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            REQUIRE_FALSE(within(joined.points[i], joined.points[j], 0.05));
    CHECK(tf::join_points_within(joined, 0.05) == joined);
}

TEST_CASE("join_within: a hundred thousand equal points are one") {
    const std::vector<point3> points(100000, point3{1, 2, 3});
    CHECK(find_points_within(points, 1e-3).first_of_new.size() == 1);
}
