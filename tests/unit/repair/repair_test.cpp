/// \file
/// `repair`: each kind of dirt on a solid, and the solid that comes back.

#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/repaired.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace {

using test::is_manifold_in_coordinates;
using test::require_solid;
using test::turn;

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
    CHECK(result.statistics.turned_outward == 0);
    for (tf::face& f : dirty.faces) turn(f);
    result = tf::repair(dirty);
    require_solid(result, tf::signed_volume(ball));
    CHECK(result.statistics.flipped == 4);
    CHECK(result.statistics.turned_outward == 1);
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
    CHECK(result.statistics.turned_outward == 0);
}

TEST_CASE("repair: a solid with a cavity, inside out, is turned with it") {
    const tf::mesh inner = test::ball(2, 0.5);
    const tf::mesh outer = test::ball(3, 1.0);
    const double rest = tf::signed_volume(outer) - tf::signed_volume(inner);
    const tf::mesh hollow = test::together(outer, test::inside_out(inner));
    const tf::repair_result result = tf::repair(test::inside_out(hollow));
    require_solid(result, rest);
    CHECK(result.statistics.turned_outward == 2);
    CHECK(result.mesh.faces == test::inside_out(test::inside_out(hollow)).faces);
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
    CHECK(result.statistics.turned_outward == 1);
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
    // The edge where two cubes touch is moved apart, and the small one is left with a corner
    // outside.
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
    const tf::repair_options generous{.stray_share = 0.3};
    tf::repair_result result = tf::repair(dirty, generous);
    CHECK(result.certificate.status == tf::status::excessive_loss);
    CHECK(result.certificate.size_before == doctest::Approx(6.5));
    CHECK(result.certificate.size_after == doctest::Approx(5.5));
    CHECK(!result.certificate.size_is_volume);
    CHECK(result.statistics.area_lost == doctest::Approx(1.0));
    result = tf::repair(dirty, {.stray_share = 0.3, .max_loss = 1.0});
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
    CHECK(tf::find_solid_defects(test::box(1, 1, 1)).message() == "no defects");
    tf::mesh unused = test::box(1, 1, 1);
    unused.points.push_back({std::numeric_limits<double>::quiet_NaN(), 0, 0});
    CHECK(tf::find_solid_defects(unused).message() == "1 vertex that is not finite");
    tf::mesh open = test::box(1, 1, 1);
    open.faces.pop_back();
    turn(open.faces[0]);
    tf::solid_defects found = tf::find_solid_defects(open);
    CHECK(found.boundary_edges == 3);
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
    CHECK(tf::find_solid_defects(ball, [](double) { return false; }).status ==
          tf::status::cancelled);
}

TEST_CASE("repair: what cannot be used is a defect, and no error") {
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    tf::mesh broken = test::box(1, 1, 1);
    broken.points.push_back({0, std::numeric_limits<double>::infinity(), 0});
    broken.points.push_back({nothing, 0, 0});
    broken.faces.insert(broken.faces.begin() + 3, {0, 1, 8});
    broken.faces.push_back({0, 1, 10});
    tf::solid_defects found = tf::find_solid_defects(broken);
    CHECK(found.nonfinite_vertices == 2);
    CHECK(found.unusable_faces == 2);
    CHECK(found.any());
    CHECK(found.boundary_edges + found.degenerate + found.meeting_pairs == 0);
    CHECK(
        found.message() ==
        "2 vertices that are not finite, 2 faces with a corner that is not finite or not a vertex");
    CHECK(!tf::find_solid_defects(tf::mesh{}).any());
    found = tf::find_solid_defects(tf::mesh{{{0, 0, 0}}, {}});
    CHECK(found.without_faces);
    CHECK(found.message() == "there are points, but no faces");
    CHECK(tf::find_solid_defects(tf::mesh{{{0, 0, nothing}}, {{0, 0, 0}}}).without_faces);
}

TEST_CASE("repair: bad arguments") {
    const tf::mesh box = test::box(1, 1, 1);
    CHECK_THROWS_AS((void)tf::repair(box.points), std::invalid_argument);  // a cloud
    CHECK_THROWS_AS((void)tf::repair(box, {.gap = -1.0}), std::invalid_argument);
    CHECK_THROWS_AS((void)tf::repair(box, {.stray_share = std::numeric_limits<double>::infinity()}),
                    std::invalid_argument);
    tf::mesh broken = box;
    broken.faces[3][1] = 8;
    CHECK_THROWS_AS((void)tf::repair(broken), std::invalid_argument);
    CHECK(tf::repair(tf::mesh{}).mesh == tf::mesh{});
}
