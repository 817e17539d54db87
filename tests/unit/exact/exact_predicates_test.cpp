#include <libmesh/exact/filter.hpp>
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
#include <numeric>
#include <vector>

#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace {

using test::greatest;
using test::least;
using tf::point2;
using tf::point3;
using tf::detail::exact::undecided;
using tf::test::each;
using tf::test::point_family;

constexpr point3 origin{0, 0, 0};
constexpr point3 ex{1, 0, 0};
constexpr point3 ey{0, 1, 0};
constexpr point3 ez{0, 0, 1};

/// The signs of all predicates on one group of nine points.
std::vector<int> all_signs(const std::vector<point3>& p) {
    const tf::plane_points first{p[0], p[1], p[2]};
    const tf::plane_points second{p[3], p[4], p[5]};
    const tf::plane_points third{p[6], p[7], p[8]};
    return {tf::orient2d({p[0].x, p[0].y}, {p[1].x, p[1].y}, {p[2].x, p[2].y}),
            tf::orient2d(0, p[0], p[1], p[2]),
            tf::orient2d(1, p[0], p[1], p[2]),
            tf::orient2d(2, p[0], p[1], p[2]),
            tf::orient3d(p[0], p[1], p[2], p[3]),
            tf::collinear(p[0], p[1], p[2]) ? 1 : 0,
            tf::compare_along(p[0], p[1], p[2], p[3]),
            tf::compare_distance(p[0], p[1], p[2], p[3]),
            tf::normal_dot(first, second),
            tf::normal_turn(first, second, p[6], p[7]),
            tf::normal_determinant(first, second, third)};
}

/// Calls `check` with groups of nine points of every family.
template <class Function>
void for_each_group(int groups, const Function& check) {
    for (std::size_t f = 0; f < tf::test::point_family_names.size(); ++f) {
        CAPTURE(tf::test::point_family_names[f]);
        tf::test::point_stream stream(static_cast<point_family>(f), 2024);
        for (int i = 0; i < groups; ++i) check(stream.next(9));
    }
}

/// Whether the order 0, 1, ... is reached from `order` by an even number of swaps.
template <std::size_t Count>
int parity_of(const std::array<std::size_t, Count>& order) {
    int parity = 1;
    for (std::size_t i = 0; i < Count; ++i)
        for (std::size_t j = i + 1; j < Count; ++j)
            if (order[i] > order[j]) parity = -parity;
    return parity;
}

TEST_CASE("orient2d is +1 for a left turn") {
    CHECK(tf::orient2d({0, 0}, {1, 0}, {0, 1}) == 1);
    CHECK(tf::orient2d({0, 0}, {0, 1}, {1, 0}) == -1);
    CHECK(tf::orient2d({0, 0}, {1, 1}, {2, 2}) == 0);
    CHECK(tf::orient2d({0, 0}, {0, 0}, {2, 2}) == 0);
}

TEST_CASE("orient2d along an axis is the sign of that component of the normal") {
    CHECK(tf::orient2d(0, origin, ey, ez) == 1);
    CHECK(tf::orient2d(1, origin, ez, ex) == 1);
    CHECK(tf::orient2d(2, origin, ex, ey) == 1);
    CHECK(tf::orient2d(0, origin, ex, ey) == 0);
    CHECK(tf::orient2d(1, origin, ex, ez) == -1);
}

TEST_CASE("orient3d is +1 where the normal points") {
    CHECK(tf::orient3d(origin, ex, ey, ez) == 1);
    CHECK(tf::orient3d(origin, ex, ey, {0, 0, -1}) == -1);
    CHECK(tf::orient3d(origin, ex, ey, {3, 4, 0}) == 0);
    CHECK(tf::orient3d(origin, ex, ey, ex) == 0);
}

TEST_CASE("points on one line are collinear, equal points too") {
    CHECK(tf::collinear(origin, {1, 2, 3}, {2, 4, 6}));
    CHECK(tf::collinear(ex, ex, ey));
    CHECK(tf::collinear(ex, ex, ex));
    CHECK_FALSE(tf::collinear(ex, ey, ez));
    CHECK_FALSE(tf::collinear(origin, {1, 2, 3}, {2, 4, std::nextafter(6.0, 7.0)}));
    // One projection alone tells them apart.
    CHECK_FALSE(tf::collinear(origin, ex, {2, least, 0}));
    CHECK_FALSE(tf::collinear(origin, {1, 1, 1}, {1, 1, 0}));
}

TEST_CASE("compare_along tells what lies ahead") {
    CHECK(tf::compare_along(origin, ex, ex, {2, 5, 5}) == 1);
    CHECK(tf::compare_along(origin, ex, {2, 5, 5}, ex) == -1);
    CHECK(tf::compare_along(origin, ex, ex, {1, 5, 5}) == 0);
    CHECK(tf::compare_along(ex, ex, origin, ey) == 0);
}

TEST_CASE("compare_distance compares lengths") {
    CHECK(tf::compare_distance(origin, {2, 0, 0}, ex, origin) == 1);
    CHECK(tf::compare_distance(origin, ex, origin, {0, -2, 0}) == -1);
    CHECK(tf::compare_distance(origin, {3, 4, 0}, ex, {1, 0, 5}) == 0);
    CHECK(tf::compare_distance(ex, ex, ey, ey) == 0);
}

TEST_CASE("normals: dot, turn and determinant follow the right hand") {
    const tf::plane_points x{origin, ey, ez};
    const tf::plane_points y{origin, ez, ex};
    const tf::plane_points z{origin, ex, ey};
    CHECK(tf::normal_dot(x, x) == 1);
    CHECK(tf::normal_dot(x, {origin, ez, ey}) == -1);
    CHECK(tf::normal_dot(x, y) == 0);
    CHECK(tf::normal_turn(x, y, origin, ez) == 1);
    CHECK(tf::normal_turn(y, x, origin, ez) == -1);
    CHECK(tf::normal_turn(x, y, origin, ex) == 0);
    CHECK(tf::normal_determinant(x, y, z) == 1);
    CHECK(tf::normal_determinant(y, x, z) == -1);
    CHECK(tf::normal_determinant(x, y, {ex, {1, 0, 1}, {1, 1, 0}}) == 0);
}

TEST_CASE("swapping two arguments of an orientation flips its sign, in every permutation") {
    for_each_group(30, [](const std::vector<point3>& p) {
        const int turn = tf::orient2d(2, p[0], p[1], p[2]);
        const bool line = tf::collinear(p[0], p[1], p[2]);
        std::array<std::size_t, 3> three{0, 1, 2};
        do {
            const auto& [i, j, k] = three;
            REQUIRE(tf::orient2d(2, p[i], p[j], p[k]) == turn * parity_of(three));
            REQUIRE(tf::collinear(p[i], p[j], p[k]) == line);
        } while (std::next_permutation(three.begin(), three.end()));

        const int side = tf::orient3d(p[0], p[1], p[2], p[3]);
        std::array<std::size_t, 4> four{0, 1, 2, 3};
        do {
            const auto& [i, j, k, l] = four;
            REQUIRE(tf::orient3d(p[i], p[j], p[k], p[l]) == side * parity_of(four));
        } while (std::next_permutation(four.begin(), four.end()));
    });
}

TEST_CASE("swapping points or planes of the other predicates changes signs as their products do") {
    for_each_group(30, [](const std::vector<point3>& p) {
        const tf::plane_points n{p[0], p[1], p[2]};
        const tf::plane_points n_turned{p[1], p[2], p[0]};
        const tf::plane_points n_flipped{p[0], p[2], p[1]};
        const tf::plane_points m{p[3], p[4], p[5]};
        const tf::plane_points k{p[6], p[7], p[8]};

        const int along = tf::compare_along(p[0], p[1], p[2], p[3]);
        REQUIRE(tf::compare_along(p[1], p[0], p[2], p[3]) == -along);
        REQUIRE(tf::compare_along(p[0], p[1], p[3], p[2]) == -along);
        REQUIRE(tf::compare_along(p[2], p[3], p[0], p[1]) == along);

        const int longer = tf::compare_distance(p[0], p[1], p[2], p[3]);
        REQUIRE(tf::compare_distance(p[2], p[3], p[0], p[1]) == -longer);
        REQUIRE(tf::compare_distance(p[1], p[0], p[3], p[2]) == longer);
        REQUIRE(tf::compare_distance(p[0], p[1], p[1], p[0]) == 0);

        const int facing = tf::normal_dot(n, m);
        REQUIRE(tf::normal_dot(m, n) == facing);
        REQUIRE(tf::normal_dot(n_turned, m) == facing);
        REQUIRE(tf::normal_dot(n_flipped, m) == -facing);

        const int turn = tf::normal_turn(n, m, p[6], p[7]);
        REQUIRE(tf::normal_turn(m, n, p[6], p[7]) == -turn);
        REQUIRE(tf::normal_turn(n, m, p[7], p[6]) == -turn);
        REQUIRE(tf::normal_turn(n_turned, m, p[6], p[7]) == turn);
        REQUIRE(tf::normal_turn(n, n_flipped, p[6], p[7]) == 0);

        const int determinant = tf::normal_determinant(n, m, k);
        REQUIRE(tf::normal_determinant(m, k, n) == determinant);
        REQUIRE(tf::normal_determinant(m, n, k) == -determinant);
        REQUIRE(tf::normal_determinant(n_flipped, m, k) == -determinant);
        REQUIRE(tf::normal_determinant(n, m, n_turned) == 0);
    });
}

TEST_CASE("scaling by a power of two changes no sign, from 2^-900 to 2^900") {
    for_each_group(30, [](const std::vector<point3>& points) {
        for (const int power : {-900, -300, -1, 1, 300, 900}) {
            const auto scaled = each(points, [&](double x) { return std::ldexp(x, power); });
            // Where nothing was lost, that is.
            if (each(scaled, [&](double x) { return std::ldexp(x, -power); }) != points) continue;
            REQUIRE(all_signs(scaled) == all_signs(points));
        }
    });
}

TEST_CASE("moving a whole lattice changes no sign") {
    tf::test::random_source random(3);
    for (int i = 0; i < 300; ++i) {
        std::vector<point3> points(9);
        points = each(points, [&](double) { return random.whole(-4, 4); });
        const std::vector<int> signs = all_signs(points);
        for (const double offset : {1.0, 1e6, 1e9, 0x1p49})
            REQUIRE(all_signs(each(points, [&](double x) { return x + offset; })) == signs);
    }
}

TEST_CASE("exchanging axes in a cycle changes no sign") {
    for_each_group(30, [](const std::vector<point3>& points) {
        std::vector<point3> turned = points;
        for (point3& p : turned) p = {p.y, p.z, p.x};
        std::vector<int> signs = all_signs(points);
        std::vector<int> turned_signs = all_signs(turned);
        REQUIRE(tf::orient2d(0, points[0], points[1], points[2]) ==
                tf::orient2d(2, turned[0], turned[1], turned[2]));
        // The first four are projections, which turn with the axes.
        signs.erase(signs.begin(), signs.begin() + 4);
        turned_signs.erase(turned_signs.begin(), turned_signs.begin() + 4);
        REQUIRE(turned_signs == signs);
    });
}

TEST_CASE("the sign of a zero does not matter") {
    for_each_group(60, [](const std::vector<point3>& points) {
        REQUIRE(all_signs(each(points, [](double x) { return x == 0.0 ? -0.0 : x; })) ==
                all_signs(each(points, [](double x) { return x == 0.0 ? 0.0 : x; })));
    });
    CHECK(tf::orient3d({0, 0, -0.0}, ex, {0, 1, -0.0}, {7, 7, 0}) == 0);
}

TEST_CASE("the smallest and the largest doubles are decided") {
    CHECK(tf::orient2d({0, 0}, {least, 0}, {0, least}) == 1);
    CHECK(tf::orient2d({least, least}, {2 * least, 2 * least}, {3 * least, 3 * least}) == 0);
    CHECK(tf::orient2d({-greatest, -greatest}, {greatest, -greatest}, {-greatest, greatest}) == 1);
    CHECK(tf::orient2d({-greatest, -greatest}, {0, 0}, {greatest, greatest}) == 0);
    CHECK(tf::orient3d(origin, {least, 0, 0}, {0, least, 0}, {0, 0, -least}) == -1);
    CHECK(tf::orient3d(origin, {greatest, 0, 0}, {0, greatest, 0}, {1, 1, least}) == 1);
    CHECK(tf::orient3d({greatest, 1, -greatest}, {-greatest, 1, greatest}, {least, 1, least},
                       {0, 1, 0}) == 0);
    CHECK(tf::orient3d(origin, {1e-300, 1e300, 0}, {1e300, 1e-300, 0}, {1, 1, least}) == -1);
    CHECK(tf::compare_distance({greatest, 0, 0}, {-greatest, 0, 0}, {0, greatest, 0},
                               {0, -greatest, 0}) == 0);
    CHECK(tf::compare_distance({greatest, 0, 0}, {-greatest, 0, 0}, {0, greatest, 0},
                               {least, -greatest, 0}) == -1);
    CHECK(tf::compare_along(origin, {greatest, least, 0}, origin, {-least, greatest, 0}) == 0);
    const tf::plane_points tiny{origin, {least, 0, 0}, {0, least, 0}};
    const tf::plane_points huge{{0, 0, greatest}, {greatest, 0, greatest}, {0, greatest, greatest}};
    CHECK(tf::normal_dot(tiny, huge) == 1);
    CHECK(tf::normal_turn(tiny, huge, origin, {greatest, least, 1}) == 0);
    CHECK(tf::normal_determinant(tiny, {origin, {0, greatest, 0}, {0, 0, least}},
                                 {origin, {0, 0, greatest}, {greatest, 0, 0}}) == 1);
}

TEST_CASE("the filter decides plain cases, and zero only by products without need to multiply") {
    using tf::detail::exact::orient2d_filter;
    using tf::detail::exact::orient3d_filter;
    CHECK(orient3d_filter(origin, ex, ey, ez) == 1);
    CHECK(orient3d_filter(origin, ey, ex, ez) == -1);
    CHECK(orient3d_filter(origin, ex, ey, {0.3, 0.7, 0}) == 0);
    CHECK(orient3d_filter(origin, ex, ey, {0.3, 0.7, -0.0}) == 0);
    CHECK(orient3d_filter({1, 1, 0.1}, {2, 1, 0.1}, {1, 3, 0.1}, {7, 7, 0.1}) == 0);
    CHECK(orient3d_filter({1, 2, 3}, {4, 5, 7}, {8, 6, 1}, {1, 2, 3}) == 0);
    CHECK(orient3d_filter(origin, {1, 0, 1}, {0, 1, 1}, {1, 1, 2}) == undecided);
    CHECK(orient3d_filter(origin, ex, ey, {0, 0, least}) == undecided);
    CHECK(orient2d_filter({0, 0}, {1, 3}, {2, 6}) == undecided);
    CHECK(orient2d_filter({0.1, 0}, {0.1, 1}, {0.1, 5}) == 0);
    CHECK(tf::detail::exact::collinear_filter(origin, ex, ey) == 1);
    CHECK(tf::detail::exact::collinear_filter(origin, ex, {0.7, 0, 0}) == 0);
    CHECK(tf::detail::exact::collinear_filter(origin, {1, 1, 0}, {2, 2, 0}) == undecided);
}

TEST_CASE("the filter's guards are inclusive") {
    using tf::detail::exact::orient2d_filter;
    const auto right_angle = [](double x, double y) {
        const int sign = orient2d_filter({0, 0}, {x, 0}, {0, y});
        CHECK(tf::orient2d({0, 0}, {x, 0}, {0, y}) == 1);
        return sign;
    };
    CHECK(right_angle(0x1p-275, 0x1p-275) == 1);
    CHECK(right_angle(0x1.fffffffffffffp-276, 0x1p-275) == undecided);
    CHECK(right_angle(0x1p400, 0x1p400) == 1);
    CHECK(right_angle(0x1.0000000000001p400, 1.0) == undecided);
    CHECK(right_angle(greatest, greatest) == undecided);
    CHECK(right_angle(least, greatest) == undecided);
}

TEST_CASE("counters tell calls, undecided ones, and the width that decided") {
    tf::predicate_counters counters;
    CHECK(tf::orient3d(origin, ex, ey, ez, &counters) == 1);
    CHECK(counters.calls == 1);
    CHECK(counters.undecided == 0);

    CHECK(tf::orient3d(origin, {1, 0, 1}, {0, 1, 1}, {1, 1, 2}, &counters) == 0);
    CHECK(counters.calls == 2);
    CHECK(counters.undecided == 1);
    CHECK(counters.by_width[0] == 1);

    const double third = 1.0 / 3.0;
    CHECK(tf::orient3d(origin, {third, 0, third}, {0, 1, 1}, {third, 1, 1 + third}, &counters) !=
          2);
    CHECK(counters.by_width[1] == 1);
    CHECK(tf::collinear(origin, {1e10, 1e-10, 0}, {2e10, 2e-10, 0}, &counters));
    CHECK(tf::orient2d({least, 0}, {0, greatest}, {0, -greatest}, &counters) != 0);
    CHECK(counters.by_width[6] == 1);
    CHECK(counters.calls == 5);
    CHECK(counters.undecided == 4);
    CHECK(std::accumulate(counters.by_width.begin(), counters.by_width.end(), std::uint64_t{0}) ==
          counters.undecided);
}

TEST_CASE("no rounding mode changes a sign") {
    for_each_group(60, [](const std::vector<point3>& points) {
        const std::vector<int> signs = all_signs(points);
        for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
            std::fesetround(mode);
            const std::vector<int> rounded = all_signs(points);
            std::fesetround(FE_TONEAREST);
            REQUIRE(rounded == signs);
        }
    });
}

#ifdef __SSE2__
/// Flushes denormal operands and results to zero while it lives.
class flush_denormals {
  public:
    flush_denormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040); }
    ~flush_denormals() { _mm_setcsr(saved_); }
    flush_denormals(const flush_denormals&) = delete;
    flush_denormals& operator=(const flush_denormals&) = delete;

  private:
    unsigned saved_;
};

TEST_CASE("flushing denormals changes no sign") {
    const auto same = [](const std::vector<point3>& points) {
        const std::vector<int> signs = all_signs(points);
        const flush_denormals flushed;
        return all_signs(points) == signs;
    };
    for_each_group(60, [&](const std::vector<point3>& points) { REQUIRE(same(points)); });
    for_each_group(60, [&](const std::vector<point3>& points) {
        for (const int power : {-1060, -1000, -500, -340})
            REQUIRE(same(each(points, [&](double x) { return std::ldexp(x, power); })));
    });
    // A flushed difference that a large one would have made count.
    const point2 b{0x1p-1023, 0x1p-100};
    const point2 c{0x1p-100, 0x1p900};
    CHECK(tf::orient2d({0, 0}, b, c) == 1);
    const flush_denormals flushed;
    CHECK(tf::orient2d({0, 0}, b, c) == 1);
    CHECK(tf::orient3d(origin, ex, {0, 1, least}, {1, 1, least}) == 0);
    CHECK(tf::orient3d(origin, ex, ey, {1, 1, least}) == 1);
    CHECK_FALSE(tf::collinear(origin, ex, {1, least, 0}));
}
#endif

}  // namespace
