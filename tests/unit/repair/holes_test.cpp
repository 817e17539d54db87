/// \file
/// Holes, cracks and edges that do not fit: what repair fills.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/repaired.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace {

using test::is_manifold_in_coordinates;
using test::require_solid;
using test::turn;

constexpr std::uint32_t none = tf::repair_result::none;

std::array<tf::point3, 3> triangle(const tf::mesh& mesh, std::size_t f) {
    const auto [a, b, c] = mesh.faces[f];
    return {mesh.points[a], mesh.points[b], mesh.points[c]};
}

/// Each face with corners of its own, moved by up to `by`.
tf::mesh torn(const tf::mesh& mesh, double by) {
    test::random source(7);
    tf::mesh soup;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        for (const tf::point3& p : triangle(mesh, f))
            soup.points.push_back(
                {p.x + source.in(-by, by), p.y + source.in(-by, by), p.z + source.in(-by, by)});
        soup.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    }
    return soup;
}

}  // namespace

TEST_CASE("repair: missing faces are filled, and faces around them stay") {
    const tf::mesh ball = test::ball(3, 1.0);
    tf::mesh dirty = ball;
    dirty.faces.erase(dirty.faces.begin() + 10);
    dirty.faces.erase(dirty.faces.begin() + 100, dirty.faces.begin() + 103);
    const tf::repair_result result = tf::repair(dirty);
    REQUIRE(result.certificate);
    CHECK(result.statistics.holes >= 2);
    CHECK(result.mesh.faces.size() == ball.faces.size());
    std::uint64_t filled = 0;
    for (std::size_t f = 0; f < result.face_source.size(); ++f) {
        if (result.face_source[f] == none)
            ++filled;
        else
            CHECK(triangle(result.mesh, f) == triangle(dirty, result.face_source[f]));
    }
    CHECK(filled == 4);
    CHECK(filled == result.statistics.filled);
    CHECK(tf::repair(dirty, {.largest_hole = 2}).certificate.status == tf::status::open_input);
    CHECK(tf::repair(dirty, {.fill = false}).certificate.open_count > 0);
}

TEST_CASE("repair: a large hole of a ball is filled by a part of a ball, a flat one stays flat") {
    const tf::mesh ball = test::ball(4, 1.0);
    tf::mesh dirty = ball;
    std::erase_if(dirty.faces, [&](const tf::face& f) {
        return ball.points[f[0]].z > 0.8 || ball.points[f[1]].z > 0.8 || ball.points[f[2]].z > 0.8;
    });
    const tf::repair_result result = tf::repair(dirty);
    REQUIRE_MESSAGE(result.certificate, result.certificate.message());
    CHECK(result.statistics.holes == 1);
    for (std::size_t v = 0; v < result.mesh.points.size(); ++v) {
        const tf::point3& p = result.mesh.points[v];
        const double radius = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
        CHECK(radius == doctest::Approx(1.0).epsilon(0.02));
        const bool is_given = result.vertex_source[v] != none;
        CHECK((is_given ? p == dirty.points[result.vertex_source[v]] : p.z > 0.6));
    }
    CHECK(tf::signed_volume(result.mesh) > 0.995 * tf::signed_volume(ball));

    tf::mesh block = test::inside_out(test::grid(8));  // its floor; the lid has a hole of 16 edges
    tf::mesh lid = test::moved(test::grid(8), {0, 0, 1});
    std::erase_if(lid.faces, [&](const tf::face& f) {
        const tf::point3& p = lid.points[f[0]];
        return p.x >= 2 && p.x < 6 && p.y >= 2 && p.y < 6;
    });
    block = test::together(block, lid);
    for (std::uint32_t i = 0; i < 8; ++i)
        for (const auto& [a, b] : {std::pair{i, i + 1}, std::pair{73 + i, 72 + i},
                                   std::pair{9 * i + 9, 9 * i}, std::pair{9 * i + 8, 9 * i + 17}}) {
            block.faces.push_back({a, b, b + 81});
            block.faces.push_back({a, b + 81, a + 81});
        }
    const tf::repair_result flat = tf::repair(block);
    REQUIRE_MESSAGE(flat.certificate, flat.certificate.message());
    CHECK(tf::signed_volume(flat.mesh) == 64.0);
    CHECK(flat.statistics.filled == 14);
    CHECK(flat.mesh.points.size() == block.points.size() - 9);
}

TEST_CASE("repair: cracks are zipped, however the faces are turned") {
    const tf::mesh ball = test::ball(3, 1.0);
    tf::mesh soup = torn(ball, 1e-5);
    turn(soup.faces[77]);
    const tf::repair_result result = tf::repair(soup);
    REQUIRE_MESSAGE(result.certificate, result.certificate.message());
    CHECK(result.mesh.points.size() == ball.points.size());
    CHECK(result.mesh.faces.size() == ball.faces.size());
    CHECK(tf::signed_volume(result.mesh) == doctest::Approx(tf::signed_volume(ball)).epsilon(1e-4));
    CHECK(result.statistics.closed_edges > ball.faces.size());
    CHECK(result.statistics.widest_closed <= 4e-5);
    CHECK(result.statistics.widest_closed > 0.0);
    CHECK(result.statistics.flipped == 1);
    CHECK(result.statistics.filled == 0);
    // A crack wider than the gap stays one.
    CHECK(tf::repair(soup, {.fill = false, .gap = 1e-7}).certificate.status ==
          tf::status::open_input);
}

TEST_CASE("repair: an edge is split at the vertices that lie on it") {
    tf::mesh dirty = test::box(2, 2, 2);  // the edge from 0 to 1 has a vertex on one side only
    dirty.points.push_back({1, 0, 0});
    dirty.faces[0] = {0, 2, 8};
    dirty.faces.push_back({2, 1, 8});
    const tf::repair_result result = tf::repair(dirty);
    require_solid(result, 8.0);
    CHECK(result.statistics.split_edges == 1);
    CHECK(result.statistics.widest_closed == 0.0);
    CHECK(result.mesh.faces.size() == 14);
}

TEST_CASE("repair: a face without area leaves no hole") {
    tf::mesh dirty = test::box(2, 2, 2);
    dirty.points.push_back({1, 0, 0});
    dirty.faces[0] = {0, 2, 8};
    dirty.faces.push_back({2, 1, 8});
    dirty.faces.push_back({0, 8, 1});
    const tf::repair_result result = tf::repair(dirty);
    require_solid(result, 8.0);
    CHECK(result.statistics.degenerate == 1);
    CHECK(result.statistics.split_edges == 1);
}

TEST_CASE("repair: a cavity stays one where the filling of a hole passes through it") {
    const tf::mesh inner = test::ball(3, 0.8);
    tf::mesh dirty = test::ball(4, 1.0);
    std::erase_if(dirty.faces, [&](const tf::face& f) { return dirty.points[f[0]].z > 0.5; });
    dirty = test::together(dirty, test::inside_out(inner));
    const tf::repair_result result = tf::repair(dirty);
    REQUIRE_MESSAGE(result.certificate, result.certificate.message());
    CHECK(result.statistics.turned_outward == 0);
    const double full = tf::signed_volume(test::ball(4, 1.0));
    CHECK(tf::signed_volume(result.mesh) < full - 0.8 * tf::signed_volume(inner));
}

TEST_CASE("repair: a hole along an edge of three faces is filled") {
    tf::mesh dirty = test::box(1, 1, 1);
    dirty.points.insert(dirty.points.end(), {{0.4, 0.4, -2}, {0.3, 0.5, -1}});
    // An open cone on the edge from 0 to 1: with what fills it, a body of its own.
    dirty.faces.insert(dirty.faces.end(), {{1, 0, 8}, {9, 1, 8}, {0, 9, 8}});
    const tf::repair_result result = tf::repair(dirty);
    REQUIRE_MESSAGE(result.certificate, result.certificate.message());
    CHECK(is_manifold_in_coordinates(result.mesh));
    CHECK(result.statistics.filled == 1);
    CHECK(tf::signed_volume(result.mesh) > 1.05);
}

TEST_CASE("repair: a flat solid without its top is filled, whatever share of it that was") {
    for (const double height : {40.0, 5.0, 0.5, 0.0625}) {
        CAPTURE(height);
        tf::mesh plate = test::box(100, 60, height);
        std::erase_if(plate.faces, [&](const tf::face& f) {
            return plate.points[f[0]].z + plate.points[f[1]].z + plate.points[f[2]].z ==
                   3.0 * height;
        });
        REQUIRE(plate.faces.size() == 10);
        for (const double angle : {0.0, 0.7}) {
            tf::mesh dirty = test::moved(test::turned(plate, {1, 2, 3}, angle), {1000, 0, 0});
            dirty.points = tf::rounded(dirty.points, tf::precision::float32);
            const tf::repair_result made = tf::repair(dirty);
            REQUIRE_MESSAGE(made.certificate, made.certificate.message());
            CHECK(made.statistics.holes == 1);
            CHECK(tf::signed_volume(made.mesh) ==
                  doctest::Approx(6000.0 * height).epsilon(1e-3 / height));
        }
    }
}

TEST_CASE("repair: what ends in a plane and goes through it, or lies in it, stays a sheet") {
    tf::mesh wave = test::grid(8);
    const tf::repair_result flat = tf::repair(wave);
    CHECK(flat.certificate.status == tf::status::open_input);
    CHECK(flat.statistics.unfilled_rims == 1);
    const auto box = *tf::bounding_box(wave.points);
    double side = 0.25;
    for (tf::point3& p : wave.points) {
        const bool is_rim =
            p.x == box.min.x || p.x == box.max.x || p.y == box.min.y || p.y == box.max.y;
        if (is_rim) continue;
        p.z += side;
        side = -side;
    }
    const tf::repair_result made = tf::repair(wave);
    CHECK(made.certificate.status == tf::status::open_input);
    CHECK(made.statistics.unfilled_rims == 1);
    for (const tf::certificate& known :
         {made.certificate, tf::resolve_self_intersections(wave).certificate}) {
        CHECK(known.open_faces.at(0).operand == tf::operand_element::none);
        CHECK(known.message().ends_with(" at face " + std::to_string(known.open_faces[0].index)));
    }
}

TEST_CASE("repair: a shell within another that faces outward, too, is counted, and odd keeps it") {
    const tf::mesh nested =
        test::together(test::box(20, 20, 20), test::moved(test::box(10, 10, 10), {5, 5, 5}));
    const tf::repair_result made = tf::repair(nested);
    REQUIRE(made.certificate);
    CHECK(tf::signed_volume(made.mesh) == 8000.0);
    CHECK(made.statistics.dropped_shells == 1);
    CHECK(made.statistics.message() == "1 shell within another dropped, 12 faces removed");
    CHECK(made.statistics.vanished_components == 0);
    const tf::repair_result hollow = tf::repair(nested, {.fill_rule = tf::fill_rule::even_odd});
    REQUIRE(hollow.certificate);
    CHECK(tf::signed_volume(hollow.mesh) == 7000.0);
    CHECK(hollow.statistics.dropped_shells == 0);
    // Overlapping ones leave something of both.
    CHECK(tf::repair(test::together(test::box(2, 2, 2), test::moved(test::box(2, 2, 2), {1, 1, 1})))
              .statistics.dropped_shells == 0);
}

TEST_CASE(
    "repair: parts that are closed by themselves keep vertices of their own where they touch") {
    const tf::mesh two =
        test::together(test::box(1, 1, 1), test::moved(test::box(1, 1, 1), {1, 1, 0}));
    for (const tf::repair_options& options :
         {tf::repair_options{.sheet = true}, tf::repair_options{.resolve = false},
          tf::repair_options{.detach = false}}) {
        const tf::repair_result made = tf::repair(two, options);
        CHECK(made.mesh.points.size() == 16);
        CHECK(made.vertex_source.size() == 16);
        CHECK(tf::count_topology(made.mesh.points.size(), made.mesh.faces).nonmanifold_edges == 0);
        for (std::size_t v = 0; v < made.vertex_source.size(); ++v)
            CHECK(two.points[made.vertex_source[v]] == made.mesh.points[v]);
    }
    // Triangles that have nothing but vertices of their own become one surface all the same.
    tf::mesh soup;
    for (const tf::face& f : test::box(1, 1, 1).faces) {
        const auto first = static_cast<std::uint32_t>(soup.points.size());
        for (const std::uint32_t corner : f)
            soup.points.push_back(test::box(1, 1, 1).points[corner]);
        soup.faces.push_back({first, first + 1, first + 2});
    }
    CHECK(tf::repair(soup, {.resolve = false}).mesh.points.size() == 8);
}

TEST_CASE("repair: a sheet is not filled, half of a ball is") {
    tf::mesh part = test::ball(4, 1.0);
    std::erase_if(part.faces, [&](const tf::face& f) {
        return part.points[f[0]].z + part.points[f[1]].z + part.points[f[2]].z < 0.0;
    });
    const tf::repair_result half = tf::repair(part);
    REQUIRE_MESSAGE(half.certificate, half.certificate.message());
    CHECK(tf::signed_volume(half.mesh) == doctest::Approx(2.07).epsilon(0.01));
    std::erase_if(part.faces, [&](const tf::face& f) { return part.points[f[0]].z < 0.7; });
    const tf::repair_result sheet = tf::repair(part);
    CHECK(sheet.certificate.status == tf::status::open_input);
    CHECK(sheet.statistics.holes == 0);
    CHECK(tf::repair(part, {.max_loss = 1.0}).certificate);  // a lens
}
