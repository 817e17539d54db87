#include <libmesh/exact/implicit_point.hpp>
#include <libmesh/exact/plane_predicates.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/extremes.hpp>
#include <support/point_families.hpp>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace {

using test::greatest;
using test::infinity;
using test::least;
using tf::implicit_point;
using tf::plane_points;
using tf::point3;
using tf::test::each;
using tf::test::point_family;

constexpr plane_points at_x(double x) { return {{x, 0, 0}, {x, 1, 0}, {x, 0, 1}}; }
constexpr plane_points at_y(double y) { return {{0, y, 0}, {0, y, 1}, {1, y, 0}}; }
constexpr plane_points at_z(double z) { return {{0, 0, z}, {1, 0, z}, {0, 1, z}}; }

/// The corner of three planes, all written down in full.
implicit_point corner(const plane_points& p, const plane_points& q, const plane_points& r) {
    return implicit_point::where_planes_meet(p, q, r);
}

constexpr plane_points diagonal{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  // x + y + z = 1

/// (1/3, 1/3, 1/3), defined in each way.
std::array<implicit_point, 5> thirds() {
    const plane_points xy{{0, 0, 0}, {1, 1, 0}, {0, 0, 1}};  // x = y
    const plane_points yz{{0, 0, 0}, {0, 1, 1}, {1, 0, 0}};  // y = z
    return {implicit_point::where_line_meets({0, 0, 0}, {1, 1, 1}, diagonal),
            implicit_point::where_line_meets({0, 0, 0}, {1, 1, 1}, {1, 0, 0}, {1, 1, 1}),
            corner(diagonal, xy, yz), corner(yz, diagonal, xy),
            implicit_point::where_lines_cross({-1, -1, -1}, {2, 2, 2}, {1, 0, 0}, {0, 0.5, 0.5})};
}

bool is_within(const implicit_point& p, double x, double y, double z) {
    return std::abs(p.center().x - x) <= p.radius() && std::abs(p.center().y - y) <= p.radius() &&
           std::abs(p.center().z - z) <= p.radius();
}

TEST_CASE("a given point is its center, of no radius") {
    const implicit_point p = point3{1, 2, 3};
    CHECK(p.kind() == implicit_point::origin::given);
    CHECK(p.center() == point3{1, 2, 3});
    CHECK(p.radius() == 0.0);
    CHECK(tf::rounded(p) == point3{1, 2, 3});
    CHECK(implicit_point().center() == point3{});
}

TEST_CASE("lines cross, a line meets a plane and three planes meet where they should") {
    const auto lines =
        implicit_point::where_lines_cross({0, 0, 5}, {4, 4, 5}, {4, 0, 5}, {0, 4, 5});
    CHECK(lines.kind() == implicit_point::origin::lines);
    CHECK(is_within(lines, 2, 2, 5));
    CHECK(tf::equal(lines, point3{2, 2, 5}));

    const auto line_plane = implicit_point::where_line_meets({1, 2, -3}, {1, 2, 7}, at_z(4));
    CHECK(line_plane.kind() == implicit_point::origin::line_plane);
    CHECK(is_within(line_plane, 1, 2, 4));
    CHECK(tf::equal(line_plane, point3{1, 2, 4}));
    CHECK_FALSE(tf::equal(line_plane, point3{1, 2, std::nextafter(4.0, 5.0)}));

    const auto across =
        implicit_point::where_line_meets({1, 2, -3}, {1, 2, 7}, {9, 9, 4}, {0, 0, 3});
    CHECK(across.kind() == implicit_point::origin::line_normal);
    CHECK(is_within(across, 1, 2, 4));
    CHECK(tf::equal(across, line_plane));

    const auto planes = corner(at_x(7), at_y(-2), at_z(0.125));
    CHECK(planes.kind() == implicit_point::origin::planes);
    CHECK(is_within(planes, 7, -2, 0.125));
    CHECK(tf::equal(planes, point3{7, -2, 0.125}));
}

TEST_CASE("a constructed point keeps what defines it, in order") {
    const auto lines =
        implicit_point::where_lines_cross({0, 0, 5}, {4, 4, 5}, {4, 0, 5}, {0, 4, 5});
    CHECK(lines.definition()[1] == point3{4, 4, 5});
    CHECK(lines.definition()[3] == point3{0, 4, 5});
    const auto planes = corner(at_x(7), at_y(-2), at_z(3));
    CHECK(planes.definition()[2] == at_x(7).c);
    CHECK(planes.definition()[8] == at_z(3).c);
}

TEST_CASE("a point is the same point however it is defined") {
    const auto points = thirds();
    for (const implicit_point& p : points) {
        for (const implicit_point& q : points) {
            REQUIRE(tf::equal(p, q));
            for (int axis = 0; axis < 3; ++axis) {
                REQUIRE(tf::compare(axis, p, q) == 0);
                REQUIRE(tf::orient2d(axis, p, q, point3{5, 1, 2}) == 0);
            }
        }
    }
}

TEST_CASE("one third lies between two neighboring doubles") {
    const double below = 1.0 / 3.0;  // rounded down
    const double above = std::nextafter(below, 1.0);
    const plane_points beyond{{1, 0, 0}, {0, 1, 0}, {0, 0, std::nextafter(1.0, 2.0)}};
    for (const implicit_point& p : thirds()) {
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(tf::compare(axis, p, point3{below, below, below}) == 1);
            CHECK(tf::compare(axis, point3{below, below, below}, p) == -1);
            CHECK(tf::compare(axis, p, point3{above, above, above}) == -1);
        }
        CHECK_FALSE(tf::equal(p, point3{below, below, below}));
        CHECK(tf::rounded(p) == point3{below, below, below});
        const auto third = static_cast<double>(1.0F / 3.0F);
        CHECK(tf::rounded_to_float(p) == point3{third, third, third});
        CHECK(tf::side(diagonal, p) == 0);
        CHECK(tf::side(beyond, p) == -1);
    }
}

TEST_CASE("coordinates round to nearest, ties to even") {
    const auto middle = [](double x, double y) {  // of the diagonals of a rectangle
        return implicit_point::where_lines_cross({x, 0, 0}, {y, 2, 0}, {x, 2, 0}, {y, 0, 0});
    };
    constexpr double ulp = 0x1p-52;
    CHECK(tf::rounded(middle(1, 1 + ulp)) == point3{1, 1, 0});
    CHECK(tf::rounded(middle(1 + ulp, 1 + 2 * ulp)) == point3{1 + 2 * ulp, 1, 0});
    CHECK(tf::rounded(middle(-1, -1 - ulp)) == point3{-1, 1, 0});
    CHECK(tf::rounded(middle(0, least)).x == 0.0);
    CHECK(tf::rounded(middle(least, 2 * least)).x == 2 * least);
    CHECK_FALSE(std::signbit(tf::rounded(middle(-0.0, -least)).x));
    CHECK_FALSE(std::signbit(tf::rounded(point3{-0.0, 1, -0.0}).z));
    CHECK_FALSE(std::signbit(tf::rounded_to_float(point3{-0.0, 1, -0.0}).x));

    constexpr double float_ulp = 0x1p-23;
    CHECK(tf::rounded_to_float(middle(1, 1 + float_ulp)).x == 1.0);
    CHECK(tf::rounded_to_float(middle(1, 1 + float_ulp + ulp)).x == 1.0 + float_ulp);
    CHECK(tf::rounded_to_float(middle(1, 1 + float_ulp - ulp)).x == 1.0);
    CHECK(tf::rounded_to_float(point3{1 + 0x1p-24, 1 + 0x3p-24, -1 - 0x1.0000001p-24}) ==
          point3{1, 1 + 2 * float_ulp, -1 - float_ulp});
    // The nearest double is a tie of floats, the point is not.
    const auto beside = implicit_point::where_lines_cross(
        {1, 0, 0}, {1 + float_ulp, 1, 0}, {0, 0.5 + 0x1p-53, 0}, {2, 0.5 + 0x1p-53, 0});
    CHECK(tf::rounded_to_float(beside).x == 1.0 + float_ulp);
    CHECK(tf::rounded_to_float(point3{0x1.ffffffp127, 1e300, -0x1p-150}) ==
          point3{infinity, infinity, 0});
    CHECK(tf::rounded_to_float(point3{0x1.fffffefffffffp127, -0x1.8p-149, 0x1p-126}) ==
          point3{0x1.fffffep127, -0x1p-148, 0x1p-126});
}

TEST_CASE("the radius is zero where coordinates are exact, and small where planes nearly agree") {
    // The line a, b is where both planes meet; only exact arithmetic sees that they differ.
    const plane_points p{{1, 2, 3}, {4, 1, 7}, {2, 6, 1}};
    const plane_points q{p.a, p.b, {2, 6, 1 + 0x1p-52}};
    const auto b = corner(p, q, at_x(4));
    CHECK(b.radius() == 0.0);
    CHECK(b.center() == p.b);
    const auto third = corner(q, at_x(2), p);
    CHECK(third.center() == point3{2, 5.0 / 3.0, 13.0 / 3.0});
    CHECK(third.radius() <= 0x1p-53 * 5);
    CHECK(third.radius() > 0.0);
    const auto far = implicit_point::where_line_meets({0, 0, 1}, {3, 1, 1 - 0x1p-45}, at_z(0));
    CHECK(tf::equal(far, point3{3 * 0x1p45, 0x1p45, 0}));
}

TEST_CASE("what has no single point in common is refused") {
    CHECK_THROWS_AS((void)corner(at_x(0), at_x(1), at_y(0)), std::invalid_argument);
    CHECK_THROWS_AS((void)corner(at_x(0), at_y(1), {{0, 0, 0}, {1, 1, 1}, {1, 1, 2}}),
                    std::invalid_argument);
    CHECK_THROWS_AS((void)implicit_point::where_line_meets({0, 0, 1}, {1, 5, 1}, at_z(0)),
                    std::invalid_argument);
    CHECK_THROWS_AS(
        (void)implicit_point::where_lines_cross({0, 0, 1}, {1, 5, 1}, {0, 1, 1}, {2, 11, 1}),
        std::invalid_argument);
}

TEST_CASE("a point beyond the range of double is decided, and rounds to infinity") {
    const auto p = implicit_point::where_line_meets({0, 0, 1}, {greatest, 0, 0.5}, at_z(-2));
    CHECK(p.radius() == infinity);
    CHECK(std::isfinite(p.center().x));
    CHECK(tf::compare(0, p, point3{greatest, 0, 0}) == 1);
    CHECK(tf::compare(2, p, point3{0, 0, -2}) == 0);
    CHECK(tf::compare(1, p, point3{0, 0, -2}) == 0);
    CHECK(tf::equal(p, p));
    CHECK(tf::side(at_z(-2), p) == 0);
    CHECK(tf::orient2d(1, p, point3{0, 0, 1}, point3{greatest, 0, 0.5}) == 0);
    CHECK(tf::orient2d(2, p, point3{0, 0, 0}, point3{0, -1, 0}) == 1);
    CHECK(tf::rounded(p) == point3{infinity, 0, -2});
    CHECK(tf::rounded_to_float(p) == point3{infinity, 0, -2});
}

/// Groups made of points of every family.
template <class Function>
void for_each_large_group(int groups, const Function& check) {
    for (std::size_t f = 0; f < tf::test::point_family_names.size(); ++f) {
        CAPTURE(tf::test::point_family_names[f]);
        tf::test::point_stream stream(static_cast<point_family>(f), 77);
        for (int i = 0; i < groups; ++i) check(stream.next(16));
    }
}

/// Points made from a group, as many as there are: planes and lines may be parallel.
std::vector<implicit_point> points_of(const std::vector<point3>& given) {
    const auto plane = [&](std::size_t i) {
        return plane_points{given[i], given[i + 1], given[i + 2]};
    };
    std::vector<implicit_point> points;
    const auto add = [&](const auto& make) {
        try {
            points.push_back(make());
        } catch (const std::invalid_argument&) {
        }
    };
    // The first three lie on one line.
    add([&] { return corner(plane(0), plane(3), plane(6)); });
    add([&] { return corner(plane(3), plane(9), plane(0)); });
    add([&] { return corner(plane(13), plane(3), plane(0)); });
    add([&] { return implicit_point::where_line_meets(given[0], given[1], plane(3)); });
    add([&] { return implicit_point::where_line_meets(given[10], given[11], plane(0)); });
    add([&] { return implicit_point::where_line_meets(given[4], given[5], given[9], given[14]); });
    add([&] {
        return implicit_point::where_lines_cross(given[12], given[13], given[12], given[14]);
    });
    points.emplace_back(given[12]);
    points.emplace_back(given[13]);
    return points;
}

std::vector<int> signs_of_points(const std::vector<point3>& given) {
    const auto points = points_of(given);
    const plane_points plane{given[0], given[1], given[2]};
    const plane_points other{given[13], given[14], given[15]};
    std::vector<int> signs;
    for (int axis = 0; axis < 3; ++axis) {
        signs.push_back(tf::normal_cross(axis, plane, other));
        for (std::size_t i = 0; i + 2 < points.size(); ++i) {
            signs.push_back(tf::orient2d(axis, points[i], points[i + 1], points[i + 2]));
            signs.push_back(tf::compare(axis, points[i], points[i + 1]));
        }
    }
    for (const implicit_point& p : points) {
        signs.push_back(tf::side(plane, p));
        signs.push_back(tf::side(other, p));
        signs.push_back(tf::equal(p, points.front()) ? 1 : 0);
    }
    return signs;
}

TEST_CASE(
    "points lie in the planes and on the lines that define them, whatever their coordinates") {
    for_each_large_group(20, [](const std::vector<point3>& given) {
        for (const implicit_point& p : points_of(given)) {
            using origin = implicit_point::origin;
            const auto& d = p.definition();
            if (p.kind() == origin::line_plane) REQUIRE(tf::side({d[2], d[3], d[4]}, p) == 0);
            if (p.kind() == origin::planes)
                for (std::size_t i = 0; i < 9; i += 3)
                    REQUIRE(tf::side({d[i], d[i + 1], d[i + 2]}, p) == 0);
            if (p.kind() == origin::lines || p.kind() == origin::line_plane)
                for (int axis = 0; axis < 3; ++axis)
                    REQUIRE(tf::orient2d(axis, d[0], d[1], p) == 0);
            if (p.kind() == origin::lines) REQUIRE(tf::equal(p, d[0]));
        }
    });
}

TEST_CASE("swapping points changes signs as it should, in every permutation") {
    for_each_large_group(6, [](const std::vector<point3>& given) {
        const auto points = points_of(given);
        for (std::size_t i = 0; i + 2 < points.size(); ++i) {
            const auto p = [&](std::size_t k) -> const implicit_point& { return points[i + k]; };
            for (int axis = 0; axis < 3; ++axis) {
                const int turn = tf::orient2d(axis, p(0), p(1), p(2));
                REQUIRE(tf::orient2d(axis, p(1), p(2), p(0)) == turn);
                REQUIRE(tf::orient2d(axis, p(2), p(0), p(1)) == turn);
                REQUIRE(tf::orient2d(axis, p(1), p(0), p(2)) == -turn);
                REQUIRE(tf::orient2d(axis, p(0), p(2), p(1)) == -turn);
                REQUIRE(tf::orient2d(axis, p(2), p(1), p(0)) == -turn);
                REQUIRE(tf::compare(axis, p(0), p(1)) == -tf::compare(axis, p(1), p(0)));
            }
            REQUIRE(tf::equal(p(0), p(1)) == tf::equal(p(1), p(0)));
            REQUIRE(tf::equal(p(0), p(0)));
            const bool same = tf::compare(0, p(0), p(1)) == 0 && tf::compare(1, p(0), p(1)) == 0 &&
                              tf::compare(2, p(0), p(1)) == 0;
            REQUIRE(tf::equal(p(0), p(1)) == same);
        }
        const plane_points n{given[0], given[1], given[2]};
        const plane_points m{given[3], given[4], given[5]};
        for (int axis = 0; axis < 3; ++axis) {
            const int sign = tf::normal_cross(axis, n, m);
            REQUIRE(tf::normal_cross(axis, m, n) == -sign);
            REQUIRE(tf::normal_cross(axis, {n.b, n.c, n.a}, m) == sign);
            REQUIRE(tf::normal_cross(axis, {n.b, n.a, n.c}, m) == -sign);
            REQUIRE(tf::normal_cross(axis, n, n) == 0);
        }
    });
}

TEST_CASE("normal_cross follows the right hand") {
    CHECK(tf::normal_cross(2, at_x(0), at_y(0)) == 1);
    CHECK(tf::normal_cross(2, at_y(0), at_x(0)) == -1);
    CHECK(tf::normal_cross(0, at_y(4), at_z(1)) == 1);
    CHECK(tf::normal_cross(1, at_z(4), at_x(1)) == 1);
    CHECK(tf::normal_cross(1, at_y(4), at_z(1)) == 0);
}

TEST_CASE("scaling by a power of two changes no sign") {
    for_each_large_group(6, [](const std::vector<point3>& given) {
        for (const int power : {-900, -300, -1, 300, 900}) {
            const auto scaled = each(given, [&](double x) { return std::ldexp(x, power); });
            // Where nothing was lost, that is.
            if (each(scaled, [&](double x) { return std::ldexp(x, -power); }) != given) continue;
            REQUIRE(signs_of_points(scaled) == signs_of_points(given));
        }
    });
}

TEST_CASE("exchanging axes in a cycle turns the signs with them") {
    for_each_large_group(6, [](const std::vector<point3>& given) {
        std::vector<point3> turned = given;
        for (point3& p : turned) p = {p.y, p.z, p.x};
        const auto points = points_of(given);
        const auto others = points_of(turned);
        if (points.size() != others.size()) return;
        for (std::size_t i = 0; i + 2 < points.size(); ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                const int from = (axis + 1) % 3;
                REQUIRE(tf::orient2d(from, points[i], points[i + 1], points[i + 2]) ==
                        tf::orient2d(axis, others[i], others[i + 1], others[i + 2]));
                REQUIRE(tf::compare(from, points[i], points[i + 1]) ==
                        tf::compare(axis, others[i], others[i + 1]));
            }
            const point3 at = tf::rounded(points[i]);
            REQUIRE(tf::rounded(others[i]) == point3{at.y, at.z, at.x});
        }
    });
}

TEST_CASE("constructed from given points that are known, signs are those of given points") {
    tf::test::random_source random(5);
    const auto whole = [&] {
        const double x = random.whole(-3, 3);
        const double y = random.whole(-3, 3);
        return point3{x, y, random.whole(-3, 3)};
    };
    for (int i = 0; i < 2000; ++i) {
        std::array<point3, 4> at;
        std::array<implicit_point, 4> made;
        for (std::size_t k = 0; k < 4; ++k) {
            const point3& p = at[k] = whole();
            const int kind = static_cast<int>(random.below(4));
            // Odd numbers make quotients that are not exact in floating point.
            made[k] = kind == 0   ? implicit_point(p)
                      : kind == 1 ? implicit_point::where_lines_cross(
                                        {p.x - 7, p.y - 7, p.z - 14}, {p.x + 3, p.y + 3, p.z + 6},
                                        {p.x - 5, p.y + 10, p.z}, {p.x + 9, p.y - 18, p.z})
                      : kind == 2 ? implicit_point::where_line_meets({p.x - 7, p.y - 7, p.z - 14},
                                                                     {p.x + 3, p.y + 3, p.z + 6},
                                                                     {{p.x + 3, p.y, p.z - 1},
                                                                      {p.x - 3, p.y, p.z + 1},
                                                                      {p.x + 5, p.y + 11, p.z}})
                                  : corner({{p.x, p.y + 3, p.z + 1}, {p.x, p.y - 5, p.z}, p},
                                           {{p.x + 3, p.y, p.z + 7}, {p.x - 6, p.y, p.z}, p},
                                           {{p.x + 7, p.y + 1, p.z}, {p.x - 5, p.y, p.z}, p});
            REQUIRE(tf::equal(made[k], p));
            REQUIRE(tf::rounded(made[k]) == p);
            REQUIRE(tf::rounded_to_float(made[k]) == p);
        }
        for (int axis = 0; axis < 3; ++axis) {
            const auto index = static_cast<std::size_t>(axis);
            REQUIRE(tf::orient2d(axis, made[0], made[1], made[2]) ==
                    tf::orient2d(axis, at[0], at[1], at[2]));
            REQUIRE(tf::compare(axis, made[0], made[1]) ==
                    (at[0][index] > at[1][index]) - (at[0][index] < at[1][index]));
        }
        REQUIRE(tf::side({at[0], at[1], at[2]}, made[3]) ==
                tf::orient3d(at[0], at[1], at[2], at[3]));
        REQUIRE(tf::equal(made[0], made[1]) == (at[0] == at[1]));
    }
}

TEST_CASE("counters tell calls, undecided ones, and the width that decided") {
    tf::predicate_counters counters;
    const auto points = thirds();
    CHECK(tf::orient2d(2, points[0], point3{1, 0, 0}, point3{1, 1, 0}, &counters) == 1);
    CHECK(tf::compare(0, points[0], point3{1, 0, 0}, &counters) == -1);
    CHECK(tf::side(at_x(0), points[0], &counters) == 1);
    CHECK_FALSE(tf::equal(points[0], point3{}, &counters));
    CHECK(counters.calls == 4);
    CHECK(counters.undecided == 0);
    CHECK(tf::orient2d(2, points[0], point3{}, point3{1, 1, 0}, &counters) == 0);
    CHECK(tf::compare(0, points[0], points[1], &counters) == 0);
    CHECK(tf::side(diagonal, points[0], &counters) == 0);
    CHECK(tf::equal(points[0], points[1], &counters));
    CHECK(counters.calls == 8);
    CHECK(counters.undecided == 4);
    CHECK(counters.by_width[1] == 4);
    // Given points are decided as given points are.
    CHECK(tf::orient2d(2, point3{}, point3{1, 3, 0}, point3{2, 6, 0}, &counters) == 0);
    CHECK(tf::side(diagonal, point3{1, 1, 1}, &counters) == 1);
    CHECK(tf::compare(0, point3{1, 1, 1}, point3{-0.0, 1, 1}, &counters) == 1);
    CHECK(tf::equal(point3{0.0, 1, 1}, point3{-0.0, 1, 1}, &counters));
    CHECK(tf::normal_cross(0, at_x(0), diagonal, &counters) == 0);
    CHECK(counters.calls == 13);
    CHECK(counters.by_width[1] == 4);
    // As wide as the coordinates that a call is about.
    CHECK(tf::orient2d(2, points[0], point3{}, point3{0x1p80, 0x1p80, 0}, &counters) == 0);
    CHECK(counters.by_width[2] == 1);
    CHECK(tf::orient2d(2, points[0], point3{}, point3{0x1p130, 0x1p130, 0}, &counters) == 0);
    CHECK(counters.by_width.back() == 1);
    CHECK(counters.calls == 15);
}

TEST_CASE("no rounding mode changes a sign or a rounded coordinate") {
    const auto all_rounded = [](const std::vector<point3>& given) {
        std::vector<point3> result;
        for (const implicit_point& p : points_of(given)) {
            result.push_back(tf::rounded(p));
            result.push_back(tf::rounded_to_float(p));
        }
        return result;
    };
    for_each_large_group(6, [&](const std::vector<point3>& given) {
        const auto signs = signs_of_points(given);
        const auto rounded = all_rounded(given);
        for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
            std::fesetround(mode);
            const auto signs_there = signs_of_points(given);
            const auto rounded_there = all_rounded(given);
            std::fesetround(FE_TONEAREST);
            REQUIRE(signs_there == signs);
            REQUIRE(rounded_there == rounded);
        }
    });
}

#ifdef __SSE2__
TEST_CASE("flushing denormals changes no sign") {
    const auto same = [](const std::vector<point3>& given) {
        const auto signs = signs_of_points(given);
        const unsigned saved = _mm_getcsr();
        _mm_setcsr(saved | 0x8040);
        const auto flushed = signs_of_points(given);
        _mm_setcsr(saved);
        return flushed == signs;
    };
    for_each_large_group(6, [&](const std::vector<point3>& given) { REQUIRE(same(given)); });
    for_each_large_group(6, [&](const std::vector<point3>& given) {
        for (const int power : {-1060, -1000, -500, -340})
            REQUIRE(same(each(given, [&](double x) { return std::ldexp(x, power); })));
    });
}
#endif

}  // namespace
