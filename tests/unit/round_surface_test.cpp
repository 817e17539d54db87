#include <libmesh/round/round_surface.hpp>
#include <libmesh/volume.hpp>

#include <doctest/doctest.h>
#include <support/solid_checks.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace {

using test::box;
using test::moved;
using test::together;

tf::exact_surface exact_of(const tf::mesh& mesh) { return {mesh.points, {}, mesh.faces}; }

}  // namespace

TEST_CASE("round: what is in doubles stays bit for bit, without the points nobody uses") {
    tf::mesh mesh = test::ball(2, 1.7);
    const tf::mesh before = mesh;
    mesh.points.push_back({5, 5, 5});
    const tf::rounded_surface result = tf::round_surface(exact_of(mesh));
    CHECK(result.certified);
    CHECK(result.surface == before);
    CHECK(result.max_move == 0.0);
    CHECK(result.steps == 0);
    CHECK(result.point_of.size() == before.points.size());
    CHECK(tf::round_surface({}).certified);
}

TEST_CASE("round: constructed points go to the nearest double or float") {
    // The corner (1/3, 1/3, 1/3) of a tetrahedron, as the meeting point of three planes.
    tf::exact_surface exact;
    exact.given = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    exact.constructed = {tf::constructed_point::where_line_meets(
        {0, 0, 0}, {1, 1, 1}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})};
    exact.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    const tf::rounded_surface result = tf::round_surface(exact);
    CHECK(result.certified);
    const double third = 1.0 / 3.0;
    CHECK(result.surface.points.back() == tf::point3{third, third, third});
    CHECK(result.max_move > 0.0);
    CHECK(result.max_move < 0x1p-52);
    const tf::rounded_surface single = tf::round_surface(exact, {.to_float = true});
    CHECK(single.certified);
    const auto nearest = static_cast<double>(1.0F / 3.0F);
    CHECK(single.surface.points.back() == tf::point3{nearest, nearest, nearest});
    CHECK(single.max_move >= std::abs(nearest - third) - 0x1p-54);
    CHECK(single.max_move < 0x1p-24);
}

TEST_CASE("round: boxes that floats push into each other become one solid") {
    // As doubles apart by 2^-30; as floats the second begins where the first ends, and a third is
    // thinner than what floats show.
    const double one = 1.0 + 0x1p-30;
    tf::mesh mesh = together(box(1, 1, 1), moved(box(1, 1, 1), {one, 0.25, 0.25}));
    mesh = together(mesh, moved(box(1, 1, 0x1p-30), {0, 5, 1}));
    const tf::rounded_surface exact = tf::round_surface(exact_of(mesh));
    CHECK(exact.certified);
    CHECK(exact.surface == mesh);
    const tf::rounded_surface result = tf::round_surface(exact_of(mesh), {.to_float = true});
    CHECK(result.certified);
    CHECK(result.steps > 0);
    CHECK(test::is_clean_solid(result.surface));
    CHECK(std::abs(tf::signed_volume(result.surface) - 2.0) < 1e-6);
    for (std::size_t f = 0; f < result.surface.faces.size(); ++f) CHECK(result.face_of[f] < 24);
}

TEST_CASE("round: parts that rounding turns inside out vanish, and gaps close") {
    // Two walls whose sides pass each other when they are rounded: the first is solid, 2^-26 thick
    // at one end; the second is a gap between two boxes.
    tf::mesh wall = box(1, 1, 1);
    for (tf::point3& p : wall.points)
        if (p.z == 1.0) p.z = 0x1p-26 * (1 + p.x);
    for (tf::point3& p : wall.points) p.z += 1.0 + 0x1p-24;
    const tf::rounded_surface result = tf::round_surface(exact_of(wall), {.to_float = true});
    CHECK(result.certified);
    CHECK(test::is_clean_solid(result.surface));
}

TEST_CASE("round: of a part that vanishes in one point, no point is left") {
    const tf::mesh speck = moved(box(0x1p-40, 0x1p-40, 0x1p-40), {5, 5, 5});
    const tf::mesh solid = box(1, 1, 1);
    const tf::rounded_surface result =
        tf::round_surface(exact_of(together(speck, solid)), {.to_float = true});
    CHECK(result.certified);
    CHECK(result.surface == solid);
    CHECK(result.point_of.size() == solid.points.size());
    CHECK(result.point_of.front() == speck.points.size());
}

TEST_CASE("round: without steps, what is broken is told") {
    tf::mesh mesh = together(box(1, 1, 1), moved(box(1, 1, 1), {1 + 0x1p-30, 0.25, 0.25}));
    const tf::rounded_surface result =
        tf::round_surface(exact_of(mesh), {.to_float = true, .steps = 0});
    CHECK_FALSE(result.certified);
    CHECK(result.meeting_count > 0);
    CHECK(result.meeting.size() == result.meeting_count);
    for (const auto& [f, g] : result.meeting) CHECK(f < g);
    for (tf::point3& p : mesh.points) p.x *= 1e300;
    const tf::rounded_surface large = tf::round_surface(exact_of(mesh), {.to_float = true});
    CHECK_FALSE(large.certified);
    CHECK(large.max_move == std::numeric_limits<double>::infinity());
}

TEST_CASE("round: of a complex, every piece stays") {
    tf::mesh mesh;  // two sheets, parallel as doubles, that floats make one
    mesh.points = {{0, 0, 0},        {1, 0, 0},        {0, 1, 0},
                   {0, 0, 0x1p-160}, {2, 0, 0x1p-160}, {0, 2, 0x1p-160}};
    mesh.faces = {{0, 1, 2}, {3, 4, 5}};
    const tf::rounded_surface result =
        tf::round_surface(exact_of(mesh), {.to_float = true, .solid = false});
    CHECK(result.certified);
    CHECK(tf::self_intersections(result.surface).pairs.empty());
    CHECK(result.surface.faces.size() == 3);
}
