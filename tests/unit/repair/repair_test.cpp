/// \file
/// `repair`: each kind of dirt on a solid, and the solid that comes back.

#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr std::uint32_t none = tf::repair_result::none;

void turn(tf::face& f) { std::swap(f[1], f[2]); }

/// As programs see it that join equal coordinates.
bool is_manifold_in_coordinates(const tf::mesh& mesh) {
    const tf::mesh joined = tf::weld(mesh).mesh;
    const auto counts = tf::count_topology(joined.points.size(), joined.faces);
    return counts.closed && counts.misoriented_edges == 0 && counts.nonmanifold_points == 0;
}

void require_solid(const tf::repair_result& result, double volume) {
    REQUIRE_MESSAGE(result.certificate, result.certificate.message());
    CHECK(is_manifold_in_coordinates(result.mesh));
    CHECK(tf::self_intersections(result.mesh).pairs.empty());
    CHECK(tf::signed_volume(result.mesh) == doctest::Approx(volume));
    CHECK(result.face_source.size() == result.mesh.faces.size());
    CHECK(result.vertex_source.size() == result.mesh.points.size());
}

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

TEST_CASE("repair: a solid comes back bit for bit") {
    const tf::mesh ball = test::ball(3, 1.0);
    const tf::repair_result result = tf::repair(ball);
    require_solid(result, tf::signed_volume(ball));
    CHECK(result.mesh == ball);
    CHECK(result.statistics.flipped == 0);
    CHECK(result.statistics.resolved == false);
}

TEST_CASE("repair: flipped faces agree again, and an inverted solid is turned") {
    const tf::mesh ball = test::ball(3, 1.0);
    tf::mesh dirty = ball;
    for (const std::uint32_t f : {3U, 50U, 51U, 200U}) turn(dirty.faces[f]);
    tf::repair_result result = tf::repair(dirty);
    require_solid(result, tf::signed_volume(ball));
    CHECK(result.statistics.flipped == 4);
    CHECK(result.statistics.turned == 0);
    for (tf::face& f : dirty.faces) turn(f);
    result = tf::repair(dirty);
    require_solid(result, tf::signed_volume(ball));
    CHECK(result.statistics.flipped == 4);
    CHECK(result.statistics.turned == 1);
}

TEST_CASE("repair: a cavity stays one, and a body inside a body is not made one") {
    tf::mesh inner = test::ball(2, 0.5);
    const tf::mesh outer = test::ball(3, 1.0);
    const double rest = tf::signed_volume(outer) - tf::signed_volume(inner);
    tf::repair_result result = tf::repair(test::together(outer, inner));
    require_solid(result, tf::signed_volume(outer));
    for (tf::face& f : inner.faces) turn(f);
    result = tf::repair(test::together(outer, inner));
    require_solid(result, rest);
    CHECK(result.statistics.turned == 0);
}

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
    CHECK(result.statistics.widest <= 4e-5);
    CHECK(result.statistics.widest > 0.0);
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
    CHECK(result.statistics.widest == 0.0);
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

TEST_CASE("repair: a solid with a cavity, inside out, is turned with it") {
    const tf::mesh inner = test::ball(2, 0.5);
    const tf::mesh outer = test::ball(3, 1.0);
    const double rest = tf::signed_volume(outer) - tf::signed_volume(inner);
    const tf::mesh hollow = test::together(outer, test::inside_out(inner));
    const tf::repair_result result = tf::repair(test::inside_out(hollow));
    require_solid(result, rest);
    CHECK(result.statistics.turned == 2);
    CHECK(result.mesh.faces == test::inside_out(test::inside_out(hollow)).faces);
}

TEST_CASE("repair: a cavity stays one where the filling of a hole passes through it") {
    const tf::mesh inner = test::ball(3, 0.8);
    tf::mesh dirty = test::ball(4, 1.0);
    std::erase_if(dirty.faces, [&](const tf::face& f) { return dirty.points[f[0]].z > 0.5; });
    dirty = test::together(dirty, test::inside_out(inner));
    const tf::repair_result result = tf::repair(dirty);
    REQUIRE_MESSAGE(result.certificate, result.certificate.message());
    CHECK(result.statistics.turned == 0);
    const double full = tf::signed_volume(test::ball(4, 1.0));
    CHECK(tf::signed_volume(result.mesh) < full - 0.8 * tf::signed_volume(inner));
}

TEST_CASE("repair: copies of faces side by side go, turned or not") {
    const tf::mesh ball = test::ball(3, 1.0);
    for (const bool is_turned : {false, true}) {
        tf::mesh dirty = ball;
        for (const std::uint32_t f : {0U, 1U, 2U, 3U, 4U, 5U, 40U}) {
            dirty.faces.push_back(ball.faces[f]);
            if (is_turned && f % 2 == 0) turn(dirty.faces.back());
        }
        const tf::repair_result result = tf::repair(dirty);
        REQUIRE_MESSAGE(result.certificate, result.certificate.message());
        CHECK(result.mesh == ball);
        CHECK(result.statistics.repeated == 7);
    }
}

TEST_CASE("repair: flaps that hang on one edge go") {
    const tf::mesh box = test::box(1, 1, 1);
    tf::mesh dirty = box;
    dirty.points.insert(dirty.points.end(), {{0.5, 0.5, 0.4}, {2, 2, 2}});
    dirty.faces.insert(dirty.faces.end(), {{0, 1, 8}, {1, 0, 9}});
    const tf::repair_result result = tf::repair(dirty, {.max_loss = 1.0});
    require_solid(result, 1.0);
    CHECK(result.statistics.strays == 2);
}

TEST_CASE("repair: faces that are there twice") {
    const tf::mesh box = test::box(1, 1, 1);
    require_solid(tf::repair(test::together(box, box)), 1.0);
    for (const bool is_turned : {false, true}) {
        tf::mesh dirty = box;
        dirty.faces.push_back(box.faces[4]);
        if (is_turned) turn(dirty.faces.back());
        const tf::repair_result result = tf::repair(dirty);
        require_solid(result, 1.0);
        CHECK(result.mesh == box);
        CHECK(result.statistics.repeated == 1);
    }
    // Two boxes face to face: the square between them cancels out.
    const tf::mesh pair = test::together(box, test::moved(box, {1, 0, 0}));
    require_solid(tf::repair(pair), 2.0);
}

TEST_CASE("repair: strays and walls inside go") {
    const tf::mesh box = test::box(1, 1, 1);
    tf::mesh dirty = test::together(box, test::moved(box, {3, 0, 0}));
    const auto first = static_cast<std::uint32_t>(dirty.points.size());
    dirty.points.insert(dirty.points.end(), {{2, 0, 0}, {2.01, 0, 0}, {2, 0.01, 0}});
    dirty.faces.push_back({first, first + 1, first + 2});
    tf::repair_result result = tf::repair(dirty);
    require_solid(result, 2.0);
    CHECK(result.statistics.strays == 1);

    dirty = box;
    dirty.faces.insert(dirty.faces.end(), {{2, 3, 5}, {2, 5, 4}});  // a wall from edge to edge
    result = tf::repair(dirty);
    require_solid(result, 1.0);
    CHECK(result.statistics.strays == 2);
}

TEST_CASE("repair: patches that disagree only at edges of four faces") {
    const tf::mesh box = test::box(1, 1, 1);
    // Face to face, and all of one but the square between them is turned.
    tf::mesh dirty = test::together(box, test::moved(box, {1, 0, 0}));
    for (std::size_t f = box.faces.size(); f < dirty.faces.size(); ++f)
        if (f != 20 && f != 21) turn(dirty.faces[f]);
    const tf::repair_result result = tf::repair(dirty);
    require_solid(result, 2.0);
    CHECK(result.statistics.filled == 0);
    CHECK(result.statistics.flipped > 0);
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

TEST_CASE("repair: a mesh that is half of the faces of many tetrahedra is said to be open") {
    test::random source(3);
    for (const std::size_t faces : {300U, 2000U}) {
        const tf::mesh dirty = test::lattice_soup(source, faces, 60, 5);
        CHECK(tf::repair(dirty).certificate.status == tf::status::open_input);
    }
}

TEST_CASE("repair: solids that overlap become one") {
    const tf::mesh ball = test::ball(3, 1.0);
    tf::mesh pair = test::together(ball, test::moved(ball, {0.7, 0.3, 0.1}));
    const double joined = tf::signed_volume(tf::resolve_self_intersections(pair).value());
    tf::repair_result result = tf::repair(pair);
    require_solid(result, joined);
    CHECK(result.statistics.resolved);
    // Also where one of them is inside out.
    for (std::size_t f = ball.faces.size(); f < pair.faces.size(); ++f) turn(pair.faces[f]);
    result = tf::repair(pair);
    require_solid(result, joined);
    CHECK(result.statistics.turned == 1);
}

TEST_CASE("repair: what touches in an edge or a vertex is moved apart, in floats, too") {
    const tf::mesh box = test::box(1, 1, 1);
    for (const tf::point3 by : {tf::point3{1, 1, 0}, tf::point3{1, 1, 1}})
        for (const tf::precision of : {tf::precision::float64, tf::precision::float32}) {
            const tf::mesh pair = test::together(box, test::moved(box, by));
            const tf::repair_result result = tf::repair(pair, {.precision = of});
            require_solid(result, 2.0);
            CHECK(result.statistics.detached > 0);
            CHECK(result.statistics.touching == 0);
            CHECK(result.certificate.max_displacement > 0.0);
            CHECK(result.certificate.max_displacement < 1e-5);
            const tf::repair_result kept = tf::repair(pair, {.detach = false, .precision = of});
            REQUIRE(kept.certificate);
            CHECK(kept.certificate.max_displacement == 0.0);
            CHECK_FALSE(is_manifold_in_coordinates(kept.mesh));
        }
}

TEST_CASE("repair: a sliver and the cube that it touches are set apart") {
    // A sliver, as thin as a step of float32 at its far edge, on an edge of a cube.
    const tf::mesh sliver{{{1, 1, 0}, {1, 1, 1}, {1.5, 1.5, 0.25}, {1.5, 1.5 + 0x1p-23, 0.75}},
                          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
    const double volume = 1.0 + tf::signed_volume(sliver);
    REQUIRE(volume > 1.0);
    const tf::repair_result result = tf::repair(test::together(test::box(1, 1, 1), sliver),
                                                {.precision = tf::precision::float32});
    CHECK(result.statistics.touching == 0);
    require_solid(result, volume);
}

TEST_CASE("repair: any heap of cubes, touching as they may, is a manifold in coordinates") {
    test::random source(41);
    for (int round = 0; round < 60; ++round) {
        CAPTURE(round);
        tf::mesh heap;
        const std::size_t bits = source.below(std::size_t{1} << 27);
        double cubes = 0.0;
        for (std::size_t i = 0; i < 27; ++i) {
            if ((bits >> i & 1U) == 0) continue;
            const auto at = [&](std::size_t over) { return static_cast<double>(i / over % 3); };
            const tf::mesh cube = test::moved(test::box(1, 1, 1), {at(1), at(3), at(9)});
            heap = test::together(heap, cube);
            cubes += 1.0;
        }
        const tf::precision of = round % 2 == 0 ? tf::precision::float64 : tf::precision::float32;
        const tf::repair_result result = tf::repair(heap, {.precision = of});
        require_solid(result, cubes);
        CHECK(result.statistics.touching == 0);
        CHECK(result.certificate.max_displacement < 1e-4);
    }
}

TEST_CASE("repair: slivers go with faces that have no area, and stay where there are none") {
    // The diagonal of a side of a cube is bent by less than a step of float32, or not at all.
    const auto bent = [](double by) {
        tf::mesh cube = test::box(1, 1, 1);
        const auto [a, b, c] = cube.faces[0];
        cube.points.push_back({0.5, 0.5 - by, cube.points[a].z});
        const auto middle = static_cast<std::uint32_t>(cube.points.size() - 1);
        // (b, c) is the diagonal.
        cube.faces[0] = {a, b, middle};
        cube.faces.push_back({a, middle, c});
        cube.faces.push_back({b, c, middle});
        return cube;
    };
    const tf::repair_result kept = tf::repair(bent(0x1p-30));
    CHECK(kept.mesh == bent(0x1p-30));
    const tf::repair_result flat = tf::repair(bent(0.0));
    CHECK(flat.statistics.degenerate == 1);
    require_solid(flat, 1.0);
    const tf::mesh both = test::together(bent(0.0), test::moved(bent(0x1p-30), {2, 0, 0}));
    const tf::repair_result mended = tf::repair(both);
    CHECK(mended.statistics.degenerate == 2);
    CHECK(mended.mesh.faces.size() == 28);
    require_solid(mended, 2.0);
}

TEST_CASE("repair: a part inside another is no loss where its corner is moved away") {
    // The edge where two cubes touch is moved apart, and the small one is left with a corner outside.
    const tf::mesh cubes =
        test::together(test::box(1, 1, 1), test::moved(test::box(1, 1, 1), {-1, -1, 0}));
    const tf::mesh all = test::together(cubes, test::box(0.5, 0.5, 0.5));
    const tf::repair_result result = tf::repair(all);
    CHECK(result.statistics.detached > 0);
    CHECK(result.statistics.vanished_components == 0);
    require_solid(result, 2.0);
}

TEST_CASE("repair: boxes that others cover, faces on faces, are no loss") {
    test::random source(1);
    for (int heap = 0; heap < 100; ++heap) {
        const std::size_t boxes = 4 + source.below(20);
        tf::mesh all;
        for (std::size_t i = 0; i < boxes; ++i)
            all = test::together(std::move(all), test::lattice_box(source));
        const tf::repair_result result = tf::repair(all, {.precision = tf::precision::float32});
        CAPTURE(heap);
        REQUIRE_MESSAGE(result.certificate, result.certificate.message());
        CHECK(result.statistics.touching == 0);
        CHECK(result.statistics.vanished_components == 0);
    }
}

TEST_CASE("repair: a sheet keeps its border when asked, and is no solid otherwise") {
    tf::mesh sheet;
    sheet.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.1}};
    sheet.faces = {{0, 1, 2}, {0, 3, 2}};
    const tf::repair_result result = tf::repair(sheet, {.sheet = true});
    CHECK(result.certificate.status == tf::status::sheet);
    CHECK(result.statistics.flipped == 1);
    CHECK(result.mesh.faces.size() == 2);
    CHECK_THROWS_AS((void)result.value(), tf::not_certified_error);
}

TEST_CASE("repair: what loses too much is not certified") {
    // An open box, and a sheet as large as two of its sides that hangs in the air.
    tf::mesh dirty = test::box(1, 1, 1);
    dirty.faces.pop_back();
    dirty = test::together(dirty, test::moved(test::grid(1), {3, 0, 0}));
    const tf::repair_options generous{.strays = 0.3};
    tf::repair_result result = tf::repair(dirty, generous);
    CHECK(result.certificate.status == tf::status::excessive_loss);
    CHECK(result.certificate.size_before == doctest::Approx(6.5));
    CHECK(result.certificate.size_after == doctest::Approx(5.5));
    CHECK(!result.certificate.size_is_volume);
    CHECK(result.statistics.area_lost == doctest::Approx(1.0));
    result = tf::repair(dirty, {.strays = 0.3, .max_loss = 1.0});
    require_solid(result, 1.0);
    // With the default it is too large to go, and no solid.
    result = tf::repair(dirty);
    CHECK(result.certificate.status == tf::status::open_input);
    CHECK(result.certificate.open_count == 4);
}

TEST_CASE("repair: a fin has area and no volume, so that to drop it is no loss") {
    // The middle of the lid lies beside it.
    tf::mesh dirty = test::box(1, 1, 1);
    std::erase_if(dirty.faces, [&](const tf::face& f) {
        return std::ranges::all_of(f, [&](auto p) { return dirty.points[p].z == 1.0; });
    });
    const auto at = [&](double x, double y) {
        dirty.points.push_back({x, y, 1});
        return static_cast<std::uint32_t>(dirty.points.size() - 1);
    };
    const std::array rim{at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
    const std::uint32_t middle = at(2.5, 0.5);
    for (std::size_t i = 0; i < 4; ++i) dirty.faces.push_back({rim[i], rim[(i + 1) % 4], middle});
    const tf::repair_result result = tf::repair(dirty);
    CHECK(result.statistics.area_lost == doctest::Approx(0.75));
    require_solid(result, 1.0);
}

TEST_CASE("repair: defects are found as they are") {
    CHECK(!tf::find_solid_defects(test::box(1, 1, 1)).any());
    CHECK(tf::find_solid_defects(test::box(1, 1, 1)).message() == "none");
    tf::mesh unused = test::box(1, 1, 1);
    unused.points.push_back({std::numeric_limits<double>::quiet_NaN(), 0, 0});
    CHECK(!tf::find_solid_defects(unused).any());
    tf::mesh open = test::box(1, 1, 1);
    open.faces.pop_back();
    turn(open.faces[0]);
    tf::solid_defects found = tf::find_solid_defects(open);
    CHECK(found.open_edges == 3);
    CHECK(found.misoriented_edges > 0);
    CHECK(found.message().starts_with("open at 3 edges, "));
    const tf::mesh ball = test::ball(2, 1.0);
    found = tf::find_solid_defects(test::inside_out(ball));
    CHECK(found.inverted == 1);
    CHECK(found.message() == "1 part inside out");
    // A cavity is none; a body within a body is.
    const tf::mesh small = test::ball(2, 0.5);
    CHECK(!tf::find_solid_defects(test::together(ball, test::inside_out(small))).any());
    found = tf::find_solid_defects(test::together(ball, small));
    CHECK(found.wrongly_nested);
    CHECK(found.inverted == 0);
    found = tf::find_solid_defects(test::together(ball, test::moved(ball, {0.7, 0.3, 0.1})));
    CHECK(found.meeting_pairs > 0);
    CHECK(found.message() == std::to_string(found.meeting_pairs) + " pairs of faces meet");
    tf::mesh twice = test::box(1, 1, 1);
    twice.faces.push_back(twice.faces[3]);
    twice.faces.push_back({0, 0, 1});
    found = tf::find_solid_defects(twice);
    CHECK(found.repeated == 1);
    CHECK(found.degenerate == 1);
    CHECK(found.nonmanifold_edges == 3);
    CHECK(tf::find_solid_defects(ball, [](double) { return false; }).cancelled);
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

TEST_CASE("repair: bad arguments") {
    const tf::mesh box = test::box(1, 1, 1);
    CHECK_THROWS_AS((void)tf::repair(box, {.gap = -1.0}), std::invalid_argument);
    CHECK_THROWS_AS((void)tf::repair(box, {.strays = std::numeric_limits<double>::infinity()}),
                    std::invalid_argument);
    tf::mesh broken = box;
    broken.faces[3][1] = 8;
    CHECK_THROWS_AS((void)tf::repair(broken), std::invalid_argument);
    CHECK(tf::repair(tf::mesh{}).mesh == tf::mesh{});
}
