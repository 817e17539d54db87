/// \file
/// Solids cut by planes: pieces are certified and add up, caps are sections, planes may lie in
/// faces.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solid_checks.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace {

double volume_of(const tf::cut_result& made) {
    double volume = 0.0;
    for (const tf::cut_piece& piece : made.pieces) volume += tf::signed_volume(piece.mesh);
    return volume;
}

/// Area of the cap of plane k of a piece.
double cap_area(const tf::cut_piece& piece, std::uint32_t k) {
    tf::mesh cap{piece.mesh.points, {}};
    for (std::size_t f = 0; f < piece.cap.size(); ++f)
        if (piece.cap[f] == k) cap.faces.push_back(piece.mesh.faces[f]);
    return tf::surface_area(cap);
}

/// What holds of every cut of a solid that meets itself nowhere.
tf::cut_result checked_cut(const tf::mesh& solid, const tf::oriented_plane& plane,
                           std::span<const double> heights, const tf::cut_options& options = {}) {
    tf::cut_result made = tf::cut(solid, plane, heights, options);
    REQUIRE(made.certificate);
    CHECK(volume_of(made) ==
          doctest::Approx(tf::signed_volume(solid))
              .epsilon(options.precision == tf::precision::float32 ? 1e-5 : 1e-12));
    for (const tf::cut_piece& piece : made.pieces) {
        CHECK(piece.certificate);
        if (!piece.mesh.faces.empty()) CHECK(test::is_clean_solid(piece.mesh));
        REQUIRE(piece.face_source.size() == piece.mesh.faces.size());
        REQUIRE(piece.cap.size() == piece.mesh.faces.size());
        REQUIRE(piece.vertex_source.size() == piece.mesh.points.size());
        for (std::size_t f = 0; f < piece.cap.size(); ++f)
            CHECK((piece.cap[f] == tf::cut_piece::none) ==
                  (piece.face_source[f] != tf::cut_piece::none));
        if (options.precision == tf::precision::float32) continue;
        for (std::size_t v = 0; v < piece.vertex_source.size(); ++v)
            if (const std::uint32_t source = piece.vertex_source[v]; source != tf::cut_piece::none)
                CHECK(piece.mesh.points[v] == solid.points[source]);
    }
    return made;
}

}  // namespace

TEST_CASE("a box is cut in two, and closed") {
    const tf::mesh box = test::box(2, 3, 4);
    const tf::cut_result made = checked_cut(box, {{0, 0, 1}, {0, 0, 1}}, std::array{0.0});
    REQUIRE(made.pieces.size() == 2);
    CHECK(tf::signed_volume(made.pieces[0].mesh) == 6.0);
    CHECK(tf::signed_volume(made.pieces[1].mesh) == 18.0);
    for (const tf::cut_piece& piece : made.pieces) CHECK(cap_area(piece, 0) == 6.0);
    CHECK(tf::cut(box, {{0, 0, 1}, {0, 0, 1}}).pieces[0].mesh == made.pieces[0].mesh);
    CHECK(made.pieces[0].value() == made.pieces[0].mesh);
    // The other way around, the other one is first.
    const tf::cut_result back = tf::cut(tf::prepared_mesh(tf::mesh(box)), {{0, 0, 1}, {0, 0, -1}});
    CHECK(tf::signed_volume(back.pieces[0].mesh) == 18.0);
}

TEST_CASE("a plane in a face or beyond cuts nothing") {
    const tf::mesh box = test::box(1, 1, 1);
    const tf::cut_result made = checked_cut(box, {}, std::array{-1.0, 0.0, 1.0, 1.0, 2.0});
    REQUIRE(made.pieces.size() == 5);
    CHECK(made.pieces[2].mesh.faces.size() == 12);
    for (const std::size_t i : {0U, 1U, 3U, 4U}) CHECK(made.pieces[i].mesh.faces.empty());
    const tf::mesh tower = tf::unite(box, test::moved(test::box(2, 2, 1), {0, 0, 1})).value();
    const tf::cut_result parts = checked_cut(tower, {}, std::array{1.0});
    CHECK(tf::signed_volume(parts.pieces[0].mesh) == 1.0);
    CHECK(tf::signed_volume(parts.pieces[1].mesh) == 4.0);
    CHECK(cap_area(parts.pieces[0], 0) == 1.0);
    CHECK(cap_area(parts.pieces[1], 0) == 1.0);
}

TEST_CASE("lattice solids are cut at whole and half heights as by boxes") {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        std::vector<tf::mesh> boxes;
        for (int i = 0; i < 5; ++i) boxes.push_back(test::lattice_box(source));
        const tf::mesh solid =
            tf::boolean({boxes[0], boxes[1], boxes[2], boxes[3], boxes[4]}, {"(a+b+c)-(d^e)", 5})
                .value();
        if (solid.faces.empty()) continue;
        std::vector<double> heights;
        for (int h = 1; h < 12; ++h) heights.push_back(h / 2.0);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            tf::oriented_plane plane{{}, {}};
            plane.normal[axis] = 1.0;
            const tf::cut_result made = checked_cut(solid, plane, heights);
            for (std::size_t i = 0; i < made.pieces.size(); ++i) {
                tf::mesh slab = test::box(9, 9, 9);
                for (tf::point3& p : slab.points) {
                    const double low = i == 0 ? -1.0 : heights[i - 1];
                    p[axis] = p[axis] == 0.0 ? low : i == heights.size() ? 9.0 : heights[i];
                }
                const tf::mesh expected = tf::intersection(solid, slab).mesh;
                CHECK(tf::signed_volume(made.pieces[i].mesh) ==
                      doctest::Approx(tf::signed_volume(expected)).epsilon(1e-12));
                CHECK(tf::surface_area(made.pieces[i].mesh) ==
                      doctest::Approx(tf::surface_area(expected)).epsilon(1e-12));
            }
        }
    }
}

TEST_CASE("turned planes, one and many; caps are sections; floats") {
    test::random source(3);
    tf::mesh sponge = test::ball(3, 3.0);
    for (int i = 0; i < 8; ++i) {
        const tf::mesh hole = test::moved(test::ball(2, source.in(0.3, 1.5)),
                                          {source.in(-3, 3), source.in(-3, 3), source.in(-3, 3)});
        sponge = tf::difference(sponge, hole).value();
    }
    for (int i = 0; i < 12; ++i) {
        CAPTURE(i);
        const tf::oriented_plane plane{{source.in(-2, 2), source.in(-2, 2), source.in(-2, 2)},
                                       {source.in(-1, 1), source.in(-1, 1), source.in(-1, 1)}};
        const std::array heights{-0.5, 0.0, 0.25, 1.0};
        const tf::cut_result made = checked_cut(sponge, plane, heights);
        const tf::section_result sections = tf::section(sponge, plane, heights);
        for (std::uint32_t k = 0; k < heights.size(); ++k)
            for (const std::size_t side : {0U, 1U})
                CHECK(cap_area(made.pieces[k + side], k) ==
                      doctest::Approx(sections.layers[k].area).epsilon(1e-12));
        const tf::cut_result floats =
            checked_cut(sponge, plane, heights, {.precision = tf::precision::float32});
        for (const tf::cut_piece& piece : floats.pieces)
            for (const tf::point3& p : piece.mesh.points)
                CHECK(static_cast<double>(static_cast<float>(p.x)) == p.x);
    }
}

TEST_CASE("planes through vertices and edges of turned solids") {
    const tf::mesh box = test::box(1, 1, 1);
    for (const tf::oriented_plane& plane :
         {tf::oriented_plane{{1, 0, 0}, {1, 1, 1}}, tf::oriented_plane{{}, {1, -1, 0}},
          tf::oriented_plane{{}, {1, 1, -2}}, tf::oriented_plane{{}, {1, 1, 1}},
          tf::oriented_plane{{1, 1, 1}, {1, 1, 1}}})
        checked_cut(box, plane, std::array{0.0});
    const tf::cut_result diagonal = tf::cut(box, {{}, {1, -1, 0}});
    CHECK(tf::signed_volume(diagonal.pieces[0].mesh) == 0.5);
    const tf::mesh pair = test::together(box, test::moved(box, {1, 1, 0}));  // an edge in common
    const tf::cut_result two = tf::cut(pair, {{0, 0, 0.5}});
    REQUIRE(two.certificate);
    CHECK(volume_of(two) == 2.0);
    CHECK(test::is_clean_solid(two.pieces[0].mesh));
}

TEST_CASE("what meets itself is cut as the solid that it winds around") {
    const tf::mesh box = test::box(1, 1, 1);
    const tf::mesh both = test::together(box, test::moved(box, {0.5, 0.5, 0.5}));
    const tf::cut_result made = tf::cut(both, {{0, 0, 0.75}, {0, 0, 1}});
    REQUIRE(made.certificate);
    CHECK(volume_of(made) == 1.875);
    const tf::cut_result kept = tf::cut(both, {{0, 0, 0.75}, {0, 0, 1}}, {.keep_cuts = true});
    CHECK(volume_of(kept) == doctest::Approx(1.875).epsilon(1e-14));
    CHECK(kept.pieces.at(0).mesh.faces.size() >= made.pieces.at(0).mesh.faces.size());
    for (const tf::cut_piece& piece : made.pieces) {
        CHECK(test::is_clean_solid(piece.mesh));
        for (const std::uint32_t f : piece.face_source)
            CHECK((f < both.faces.size() || f == tf::cut_piece::none));
    }
}

TEST_CASE("heaps of boxes on a lattice, that overlap and touch, are cut in their faces") {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        tf::mesh heap;
        for (int i = 0; i < 6; ++i) heap = test::together(heap, test::lattice_box(source));
        const double volume = tf::signed_volume(tf::unite(heap, tf::mesh{}).value());
        tf::oriented_plane plane{{}, {}};
        plane.normal[seed % 3] = seed % 2 == 0 ? 1.0 : -1.0;
        if (seed % 5 == 0) plane.normal = {1, 1, -1};
        const tf::cut_result made =
            tf::cut(heap, plane, std::array{-4.0, -3.0, -1.5, -1.0, 0.0, 1.0, 1.5, 2.0, 3.0});
        REQUIRE_MESSAGE(made.certificate, made.certificate.message());
        CHECK(volume_of(made) == doctest::Approx(volume).epsilon(1e-12));
        for (const tf::cut_piece& piece : made.pieces)
            if (!piece.mesh.faces.empty()) CHECK(test::is_clean_solid(piece.mesh));
        const tf::cut_result open = tf::cut(heap, plane, std::array{1.0, 1.5}, {.caps = false});
        CHECK_MESSAGE(open.certificate, open.certificate.message());
    }
}

TEST_CASE("what is open is refused, or cut without caps") {
    tf::mesh open = test::box(1, 1, 1);
    open.faces.pop_back();
    const tf::cut_result refused = tf::cut(open, {{0, 0, 0.5}, {0, 0, 1}});
    CHECK(refused.certificate.status == tf::status::open_input);
    CHECK(refused.certificate.open_faces.at(0).operand == tf::operand_element::none);
    CHECK(refused.pieces.empty());
    for (const tf::mesh& mesh : {open, test::box(1, 1, 1)}) {
        const tf::cut_result made = tf::cut(mesh, {{0, 0, 0.5}, {0, 0, 1}}, {.caps = false});
        REQUIRE(made.certificate);
        REQUIRE(made.pieces.size() == 2);
        double area = 0.0;
        for (const tf::cut_piece& piece : made.pieces) {
            area += tf::surface_area(piece.mesh);
            for (const std::uint32_t cap : piece.cap) CHECK(cap == tf::cut_piece::none);
        }
        CHECK(area == tf::surface_area(mesh));
    }
}

TEST_CASE("pieces fit") {
    const tf::mesh box = test::box(10, 4, 6);
    const double far = std::numeric_limits<double>::infinity();
    const tf::cut_result made = tf::cut_to_fit(box, {4, 4, 5});
    REQUIRE(made.certificate);
    REQUIRE(made.pieces.size() == 6);
    CHECK(volume_of(made) == doctest::Approx(240.0).epsilon(1e-12));
    std::vector<std::uint32_t> planes;
    for (const tf::cut_piece& piece : made.pieces) {
        CHECK(test::is_clean_solid(piece.mesh));
        const auto around = tf::bounding_box(piece.mesh.points);
        REQUIRE(around.has_value());
        CHECK(around->max.x - around->min.x <= 4.0);
        CHECK(around->max.z - around->min.z <= 5.0);
        for (const std::uint32_t cap : piece.cap)
            if (cap != tf::cut_piece::none) planes.push_back(cap);
    }
    CHECK(*std::ranges::max_element(planes) == 2);  // two across x, one across z
    CHECK(tf::cut_to_fit(box, {far, far, far}).pieces.size() == 1);
    CHECK(tf::cut_to_fit(test::ball(3, 1.0), {1, 1, 1}, {.precision = tf::precision::float32})
              .pieces.size() == 8);
    CHECK_THROWS_AS((void)tf::cut_to_fit(box, {0, 1, 1}), std::invalid_argument);
    CHECK_THROWS_AS((void)tf::cut_to_fit(box, {1e-6, 1, 1}), std::invalid_argument);
}

TEST_CASE("threads change no byte") {
    const tf::mesh ball =
        test::together(test::ball(4, 1.0), test::moved(test::ball(3, 1.0), {1, 0, 0}));
    const std::vector<double> heights = tf::oriented_plane{}.layer_heights(ball.points, 0.07);
    const auto both = [&] {
        return std::pair{tf::section(ball, {}, heights), tf::cut(ball, {{}, {1, 2, 3}}, heights)};
    };
    const auto [sections, pieces] = both();
    const tf::thread_scope one(1);
    const auto [sections_alone, pieces_alone] = both();
    CHECK(sections.points == sections_alone.points);
    CHECK(sections.faces == sections_alone.faces);
    REQUIRE(pieces.pieces.size() == pieces_alone.pieces.size());
    for (std::size_t i = 0; i < pieces.pieces.size(); ++i) {
        CHECK(pieces.pieces[i].mesh == pieces_alone.pieces[i].mesh);
        CHECK(pieces.pieces[i].face_source == pieces_alone.pieces[i].face_source);
    }
}

TEST_CASE("what is no plane is refused; progress may stop it; nothing is cut in nothing") {
    const tf::mesh box = test::box(1, 1, 1);
    CHECK_THROWS_AS((void)tf::cut(box, {{}, {0, 0, 0}}), std::invalid_argument);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS((void)tf::cut(box, {}, std::array{nan}), std::invalid_argument);
    tf::mesh bad = box;
    bad.faces[0][0] = 9;
    CHECK_THROWS_AS((void)tf::cut(bad, {}), std::invalid_argument);
    for (const double until : {0.0, 0.7}) {
        tf::cut_options options;
        options.progress = [&](double done) { return done < until; };
        const tf::cut_result stopped = tf::cut(box, {{0, 0, 0.5}}, options);
        CHECK(stopped.certificate.status == tf::status::cancelled);
        CHECK(stopped.pieces.empty());
    }
    CHECK(tf::cut(tf::mesh{}, {}).pieces.size() == 2);
}
