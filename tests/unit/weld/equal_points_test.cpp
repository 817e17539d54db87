#include <libmesh/weld/equal_points.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/extremes.hpp>
#include <support/random.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <stdexcept>
#include <tuple>
#include <vector>

namespace {

using test::infinity;
using test::not_a_number;

using points = std::vector<tf::point3>;
using ids = std::vector<std::uint32_t>;

/// The words of the header, with a sorted container.
tf::point_groups equal_by_definition(const points& list) {
    std::map<std::tuple<double, double, double>, std::uint32_t> number;
    tf::point_groups result;
    for (std::uint32_t i = 0; i < list.size(); ++i) {
        const auto& [x, y, z] = list[i];
        const auto fresh = static_cast<std::uint32_t>(result.first_of_group.size());
        std::uint32_t mine = fresh;
        if (!std::isnan(x) && !std::isnan(y) && !std::isnan(z))
            mine = number.try_emplace({x, y, z}, fresh).first->second;
        if (mine == fresh) result.first_of_group.push_back(i);
        result.group_of_point.push_back(mine);
    }
    return result;
}

void check(const points& list) {
    const tf::point_groups expected = equal_by_definition(list);
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        const tf::point_groups found = tf::find_equal_points(list);
        CHECK((found.group_of_point == expected.group_of_point));
        CHECK((found.first_of_group == expected.first_of_group));
        const auto few = tf::detail::weld::few_equal_points(list);
        REQUIRE(few.has_value() == (expected.first_of_group.size() < list.size()));
        if (!few) continue;
        CHECK((few->group_of_point == expected.group_of_point));
        CHECK((few->first_of_group == expected.first_of_group));
    }
}

}  // namespace

TEST_CASE("equal_points: numbers go by first appearance") {
    const tf::point_groups found =
        tf::find_equal_points(points{{2, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 0, 0}});
    CHECK(found.group_of_point == ids{0, 1, 0, 2, 1});
    CHECK(found.first_of_group == ids{0, 1, 3});
    CHECK(tf::find_equal_points({}).group_of_point.empty());
    CHECK(tf::find_equal_points(points{{1, 2, 3}}).group_of_point == ids{0});
}

TEST_CASE("equal_points: -0 equals +0, in every coordinate, and one bit more is another point") {
    constexpr double least = std::numeric_limits<double>::denorm_min();
    check({{0.0, 0.0, 0.0}, {-0.0, 0.0, 0.0}, {0.0, -0.0, 0.0}, {0.0, 0.0, -0.0}});
    CHECK(tf::find_equal_points(points{{0.0, 1.0, -0.0}, {-0.0, 1.0, 0.0}}).first_of_group ==
          ids{0});
    CHECK(tf::find_equal_points(points{{0, 0, 0}, {least, 0, 0}, {-least, 0, 0}}).first_of_group ==
          ids{0, 1, 2});
    const double next = std::nextafter(1.0, 2.0);
    check({{1, 1, 1}, {next, 1, 1}, {1, next, 1}, {1, 1, next}, {1, 1, 1}});
    check({{1, 2, 3}, {3, 2, 1}, {2, 1, 3}, {1, 3, 2}, {2, 3, 1}, {3, 1, 2}, {1, 2, 3}});
}

TEST_CASE("equal_points: a NaN equals nothing, infinities equal themselves") {
    const points list{{not_a_number, 0, 0}, {not_a_number, 0, 0}, {0, not_a_number, 0},
                      {0, 0, not_a_number}, {infinity, 0, 0},     {-infinity, 0, 0},
                      {infinity, 0, 0},     {0, 0, not_a_number}};
    CHECK(tf::find_equal_points(list).group_of_point == ids{0, 1, 2, 3, 4, 5, 4, 6});
    check(list);
}

TEST_CASE("equal_points: as a sorted container finds them, with few and with many distinct ones") {
    for (const std::size_t side : {1U, 2U, 7U, 40U, 1000U}) {
        CAPTURE(side);
        test::random source(side);
        points list(150000);
        for (tf::point3& p : list)
            for (std::size_t axis = 0; axis < 3; ++axis)
                p[axis] = static_cast<double>(source.below(side)) * (axis == 0 ? -0.125 : 0.1);
        for (std::size_t i = 0; i < 20; ++i) list[source.below(list.size())].y = not_a_number;
        check(list);
    }
}

TEST_CASE("equal_points: two million equal points, and as many different ones on a line") {
    constexpr std::size_t count = 2000000;
    const tf::point_groups one = tf::find_equal_points(points(count, {0.5, -3.0, 1e300}));
    CHECK(one.first_of_group == ids{0});
    CHECK((one.group_of_point == ids(count, 0)));
    points line(count);
    for (std::size_t i = 0; i < count; ++i) line[i].z = static_cast<double>(i);
    CHECK(tf::find_equal_points(line).first_of_group.size() == count);
}

TEST_CASE("join_equal_points: a soup gets its neighbors back and keeps every face") {
    const tf::mesh sheet = test::grid(5);
    tf::mesh soup;
    for (const tf::face& f : sheet.faces) {
        const auto at = static_cast<std::uint32_t>(soup.points.size());
        for (const std::uint32_t corner : f) soup.points.push_back(sheet.points[corner]);
        soup.faces.push_back({at, at + 1, at + 2});
    }
    const tf::mesh joined = tf::join_equal_points(soup);
    REQUIRE(joined.points.size() == sheet.points.size());
    REQUIRE(joined.faces.size() == sheet.faces.size());
    for (std::size_t i = 0; i < sheet.faces.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(joined.points[joined.faces[i][k]] == sheet.points[sheet.faces[i][k]]);
    CHECK(tf::join_equal_points(joined) == joined);
}

TEST_CASE("join_equal_points: unused points and faces that come to repeat a corner stay") {
    const tf::mesh mesh{{{9, 9, 9}, {-0.0, 0, 0}, {0.0, 0, 0}, {1, 0, 0}}, {{1, 2, 3}, {3, 3, 3}}};
    const tf::mesh joined = tf::join_equal_points(mesh);
    CHECK(joined.points == points{{9, 9, 9}, {0, 0, 0}, {1, 0, 0}});
    CHECK(std::signbit(joined.points[1].x));  // the first, bit for bit
    CHECK(joined.faces == std::vector<tf::face>{{1, 1, 2}, {2, 2, 2}});
    CHECK(tf::join_equal_points({}) == tf::mesh{});
}

TEST_CASE("join_equal_points: a corner out of range is refused by the number of its face") {
    const tf::mesh mesh{{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 0}, {0, 1, 2}, {7, 7, 7}}};
    CHECK_THROWS_WITH_AS(
        (void)tf::join_equal_points(mesh),
        doctest::Contains("treeform::join_equal_points: face 1 has a corner out of range"),
        std::invalid_argument);
}
