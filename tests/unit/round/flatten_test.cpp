#include <libmesh/round/flatten.hpp>
#include <libmesh/round/joined_points.hpp>
#include <libmesh/round/straight_rims.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/weld.hpp>
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

/// A box of 1 x 1 x 1/2 whose sides are n x n squares, two triangles each.
tf::mesh grid_slab(std::uint32_t n) {
    tf::mesh all;
    const auto side = [&](const tf::point3& origin, const tf::point3& u, const tf::point3& v) {
        const auto first = static_cast<std::uint32_t>(all.points.size());
        for (std::uint32_t i = 0; i <= n; ++i)
            for (std::uint32_t k = 0; k <= n; ++k) {
                const double s = static_cast<double>(i) / n, t = static_cast<double>(k) / n;
                all.points.push_back({origin.x + s * u.x + t * v.x, origin.y + s * u.y + t * v.y,
                                      origin.z + s * u.z + t * v.z});
            }
        for (std::uint32_t i = 0; i < n; ++i)
            for (std::uint32_t k = 0; k < n; ++k) {
                const std::uint32_t p = first + i * (n + 1) + k, q = p + n + 1;
                all.faces.push_back({p, q, q + 1});
                all.faces.push_back({p, q + 1, p + 1});
            }
    };
    side({0, 0, 0.5}, {1, 0, 0}, {0, 1, 0});
    side({0, 0, 0}, {0, 1, 0}, {1, 0, 0});
    side({0, 0, 0}, {1, 0, 0}, {0, 0, 0.5});
    side({0, 1, 0}, {0, 0, 0.5}, {1, 0, 0});
    side({0, 0, 0}, {0, 0, 0.5}, {0, 1, 0});
    side({1, 0, 0}, {0, 1, 0}, {0, 0, 0.5});
    return tf::join_equal_points(std::move(all));
}

}  // namespace

TEST_CASE("flatten: flush parts that a matrix turned are united") {
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
            const double tolerance = precision == tf::precision::float64 ? 1e-12 : 1e-4;
            CHECK(tf::signed_volume(result.mesh) ==
                  doctest::Approx(tf::signed_volume(meant.mesh)).epsilon(tolerance));
        }
    }
}

TEST_CASE("flatten: a part with noise becomes as few faces as its rim needs") {
    // The upper side of a slab is a grid, no point of which lies exactly in a plane.
    test::random source(5);
    tf::mesh slab = grid_slab(20);
    for (tf::point3& p : slab.points)
        if (p.z > 0) p.z += 0x1p-30 * source.in(-1, 1);
    std::vector<tf::face_pair> meeting;
    for (std::uint32_t f = 0; f < slab.faces.size(); ++f) meeting.push_back({f, 0});
    const auto flat = round::flatten(slab, meeting, {.reach = 0x1p-22});
    REQUIRE(flat.has_value());
    CHECK(flat->faces.size() == 12);
    const tf::mesh made{flat->points, flat->faces};
    CHECK(is_clean_solid(made));
    CHECK(tf::signed_volume(made) == doctest::Approx(tf::signed_volume(slab)).epsilon(1e-6));
    for (const std::uint32_t f : flat->face_of) CHECK(f < slab.faces.size());
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
