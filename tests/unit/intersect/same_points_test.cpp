#include <libmesh/exact/plane_predicates.hpp>
#include <libmesh/intersect/same_points.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace {

using tf::implicit_point;

/// Points in one plane across x, each by a line through it, that the lines' other ends define, too.
std::vector<implicit_point> crossings(double x, std::uint32_t n) {
    const tf::plane_points plane{{x, 0, 0}, {x, 1, 0}, {x, 0, 1}};
    std::vector<implicit_point> points;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double y = (i % 10) / 3.0, z = (i / 10) / 7.0;
        const tf::point3 from{0, y, z}, to{3 * x, y + 0.1, z + 0.3};
        points.push_back(implicit_point::where_line_meets(from, to, plane));
        points.push_back(implicit_point::where_line_meets(to, from, plane));
    }
    return points;
}

}  // namespace

TEST_CASE("same points: those of two definitions and no others, however far out they are") {
    for (const double x : {1.0, 0x1p60, 0x1p120, 0x1p-120}) {
        const std::vector<implicit_point> points = crossings(x, 200);
        const auto pairs = tf::detail::intersect::equal_pairs(points);
        CHECK(pairs.size() == 200);
        CHECK(std::all_of(pairs.begin(), pairs.end(), [](const auto& pair) {
            return pair.first % 2 == 0 && pair.second == pair.first + 1;
        }));
    }
}

TEST_CASE("same points: at the ends of the range of doubles, too") {
    constexpr double most = std::numeric_limits<double>::max();
    const tf::plane_points plane{{most, 0, 0}, {most, 1, 0}, {most, 0, 1}};
    std::vector<implicit_point> points;
    for (const double y : {0.1, 0.3, 0.1})
        points.push_back(implicit_point::where_line_meets({0, y, 0}, {most, y, 0}, plane));
    points.push_back(tf::point3{most, 0.1, 0});
    const auto pairs = tf::detail::intersect::equal_pairs(points);
    CHECK(pairs.size() == 3);
    for (const auto& [a, b] : pairs) CHECK((a != 1 && b != 1));
}
