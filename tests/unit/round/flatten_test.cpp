#include <libmesh/round/flatten.hpp>
#include <libmesh/round/joined_points.hpp>
#include <libmesh/round/straight_rims.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solid_checks.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <vector>

namespace {

using namespace test;
namespace round = treeform::detail::round;
using sides = std::vector<round::rim_side>;

/// A plate with teeth and bars, all flush, that overlap each other.
tf::mesh flush_parts(test::random& source) {
    tf::mesh all = box(20, 4, 1);
    for (int k = 0; k < 40; ++k) {
        const double x = 19.5 * source.unit();
        all =
            together(std::move(all), moved(box(0.4, 5 + static_cast<double>(k % 3), 1), {x, 0, 0}));
    }
    for (int k = 0; k < 10; ++k)
        all = together(std::move(all), moved(box(20, 0.3, 1), {0, 6 * source.unit(), 0}));
    return all;
}

}  // namespace

TEST_CASE("flatten: flush parts that a matrix turned are as few faces as those that lie straight") {
    test::random source(7);
    for (int i = 0; i < 4; ++i) {
        CAPTURE(i);
        const tf::mesh straight = flush_parts(source);
        const tf::point3 axis{source.in(-1, 1), source.in(-1, 1), source.in(0.1, 1)};
        const tf::mesh mesh = turned(straight, axis, source.in(0.1, 3));
        const tf::boolean_result meant =
            tf::boolean({straight}, tf::boolean_expression::union_of(1));
        REQUIRE(meant.certificate);
        for (const tf::precision precision : {tf::precision::float64, tf::precision::float32}) {
            const tf::boolean_result result =
                tf::boolean({mesh}, tf::boolean_expression::union_of(1), {.precision = precision});
            CAPTURE(precision == tf::precision::float32);
            CAPTURE(result.certificate.meeting_count);
            CAPTURE(static_cast<int>(result.certificate.status));
            REQUIRE(result.certificate);
            CHECK(is_clean_solid(result.mesh));
            CHECK(2 * result.mesh.faces.size() <= result.statistics.exact_faces);
            const double tolerance = precision == tf::precision::float64 ? 1e-12 : 1e-4;
            CHECK(tf::signed_volume(result.mesh) ==
                  doctest::Approx(tf::signed_volume(meant.mesh)).epsilon(tolerance));
        }
    }
}

TEST_CASE("flatten: a wall thinner than the reach goes, what is thicker stays") {
    const tf::mesh wall = box(1, 1, 0x1p-30), block = moved(box(1, 1, 1), {2, 0, 0});
    const tf::mesh both = together(wall, block);
    std::vector<tf::face_pair> meeting;  // as if a wall met the block
    for (std::uint32_t f = 0; f < wall.faces.size(); ++f)
        meeting.push_back({f, static_cast<std::uint32_t>(wall.faces.size())});
    const auto thin = round::flatten(both, meeting, {.reach = 0x1p-28});
    REQUIRE(thin.has_value());
    CHECK(thin->faces.size() == block.faces.size());
    CHECK(thin->points == both.points);
    const auto thick = round::flatten(both, meeting, {.reach = 0x1p-32});
    REQUIRE(thick.has_value());
    CHECK(thick->faces.size() == both.faces.size());
}

TEST_CASE(
    "flatten: nearest points are joined first, never further than the reach, held ones stay") {
    const std::vector<tf::point3> points{{0, 0, 0}, {1, 0, 0}, {1.5, 0, 0}, {3, 0, 0}, {3.5, 0, 0}};
    const std::vector<std::uint32_t> near{0, 1, 2, 3, 4};
    const std::vector<std::uint8_t> held{0, 0, 0, 1, 1};
    CHECK(round::joined_points(points, near, held, 1.0) ==
          std::vector<std::uint32_t>{0, 1, 1, 3, 4});
    CHECK(round::joined_points(points, near, held, 1.6) ==
          std::vector<std::uint32_t>{0, 0, 0, 3, 4});
}

TEST_CASE("flatten: rims of two parts are straight between points that others have") {
    const std::vector<tf::point3> points{{0, 0, 0}, {1, 0.01, 0}, {2, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    const sides above{{0, 1}, {1, 2}, {2, 3}, {3, 0}}, below{{0, 4}, {1, 0}, {2, 1}, {4, 2}};
    const std::vector<std::uint8_t> none(points.size(), 0), may{1, 1};
    std::vector<sides> rims{above, below};
    round::straighten(rims, points, none, may, 0.1);
    CHECK(round::without_opposites(rims[0]) == sides{{0, 2}, {2, 3}, {3, 0}});
    CHECK(round::without_opposites(rims[1]) == sides{{0, 4}, {2, 0}, {4, 2}});
    rims = {above, below};
    round::straighten(rims, points, none, may, 0.001);
    CHECK(round::without_opposites(rims[0]) == above);
    std::vector<std::uint8_t> stays(none);
    stays[1] = 1;
    rims = {above, below};
    round::straighten(rims, points, stays, may, 0.1);
    CHECK(round::without_opposites(rims[1]) == below);
}
