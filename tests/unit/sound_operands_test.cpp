#include <treeform/mesh/boolean.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solid_checks.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace {

using test::ball;
using test::box;
using test::moved;
using test::together;
using operands = std::array<tf::mesh, 2>;

tf::solid_result evaluate(const operands& pair, const std::string& text,
                          const tf::boolean_options& options) {
    const std::array<tf::mesh_view, 2> views{pair[0], pair[1]};
    return tf::boolean(views, {text, 2}, options);
}

/// Whether the quick way, which looks for no cells, is gone all the way.
enum class quick { never, perhaps, unless_mended };

/// The results of both ways are one, for all formulas that differ.
void check_both_ways(const operands& pair, quick expected = quick::unless_mended) {
    for (const std::string text : {"a+b", "a*b", "a-b", "b-a", "a^b", "a", "b"}) {
        CAPTURE(text);
        const tf::solid_result general = evaluate(pair, text, {});
        const tf::solid_result result = evaluate(pair, text, {.sound_operands = true});
        REQUIRE(general.certified);
        CHECK(result.certified);
        const bool was_quick = result.cells == 0;
        if (expected == quick::never || general.rounding_steps > 0)
            CHECK_FALSE(was_quick);
        else if (expected == quick::unless_mended)
            CHECK(was_quick);
        CHECK(result.surface == general.surface);
        CHECK(result.source_face == general.source_face);
        CHECK(result.source_point == general.source_point);
        CHECK(result.max_move == general.max_move);
        CHECK(result.pairs == general.pairs);
        CHECK(result.cut_faces == general.cut_faces);
        CHECK(result.exact_faces == general.exact_faces);
        CHECK(test::is_clean_solid(result.surface));
    }
}

/// Turned about an axis through the origin.
tf::mesh rotated(tf::mesh mesh, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    for (tf::point3& p : mesh.points) {
        p = {p.x * c - p.y * s, p.x * s + p.y * c, p.z};
        p = {p.x, p.y * c - p.z * s, p.y * s + p.z * c};
    }
    return mesh;
}

}  // namespace

TEST_CASE("sound operands: apart, nested, equal or empty, the result is that of the general way") {
    check_both_ways({ball(3, 1.0), moved(ball(3, 1.0), {5, 0, 0})});
    check_both_ways({ball(3, 1.0), ball(3, 0.5)});
    check_both_ways({ball(3, 0.5), ball(3, 1.0)});
    check_both_ways({ball(3, 1.0), ball(3, 1.0)});
    check_both_ways({ball(2, 1.0), tf::mesh{}});
    check_both_ways({tf::mesh{}, ball(2, 1.0)});
    check_both_ways({tf::mesh{}, tf::mesh{}});
}

TEST_CASE(
    "sound operands: balls that cross, with parts that do not, give that of the general way") {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const auto at = [&] {
            return tf::point3{source.in(-1, 1), source.in(-1, 1), source.in(-1, 1)};
        };
        tf::mesh a = rotated(ball(3, 1.0), source.in(0, 3));
        a = together(a, moved(ball(2, 0.2), {source.in(1.5, 2), 0, 0}));  // perhaps in b
        tf::mesh b = moved(rotated(ball(4, 1.0), source.in(0, 3)), at());
        b = together(b, moved(ball(1, 0.1), {0, source.in(-3, -2), 0}));
        check_both_ways({a, b});
        check_both_ways({b, a});
    }
}

TEST_CASE(
    "sound operands: loose pieces that are cut off, or out of the middle, need no other way") {
    // All faces of the piece are cut, or next to such; the large ball is far from it.
    const auto check = [](const operands& pair) {
        check_both_ways(pair, quick::perhaps);  // of a^b, pieces have edges of four faces
        for (const std::string text : {"a+b", "a*b", "a-b", "b-a"})
            CHECK(evaluate(pair, text, {.sound_operands = true}).cells == 0);
    };
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const double angle = source.in(0, 3);
        const tf::mesh large = rotated(ball(3, 1.0), angle);
        const tf::mesh small = rotated(ball(1, 0.1), angle + 1.0);
        const auto aside = [&](double by) {
            return moved(large, {by, source.in(-0.1, 0.1), source.in(-0.1, 0.1)});
        };
        check({together(large, moved(small, {1.95, 0.1, 0.1})), aside(2.95)});
        check({together(large, test::inside_out(moved(small, {0.5, 0.1, 0.1}))), aside(1.5)});
    }
}

TEST_CASE("sound operands: boxes on a lattice, that touch in every way, give that of the general") {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        check_both_ways({test::lattice_box(source), test::lattice_box(source)});
    }
}

TEST_CASE("sound operands: results are sound, with cavities and edges of four faces, too") {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        // Whether a part within the region looked at is turned inside out may not be told there.
        const auto check = [](const operands& pair) { check_both_ways(pair, quick::perhaps); };
        const auto make = [&](const std::string& text) {
            return evaluate({test::lattice_box(source), test::lattice_box(source)}, text, {})
                .surface;
        };
        const tf::mesh a = make("a^b"), b = make(seed % 2 == 0 ? "a-b" : "a+b");
        check({a, b});
        check({b, a});
        const tf::mesh shell =
            evaluate({moved(box(6, 6, 6), {-0.5, -0.5, -0.5}), test::lattice_box(source)}, "a-b",
                     {})
                .surface;
        check({shell, b});
        check({a, shell});
    }
}

TEST_CASE("sound operands: turned boxes, thin ones too, give that of the general way") {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const auto make = [&] {
            const double thin = seed % 3 == 0 ? 1e-7 : source.in(0.5, 2);
            return moved(rotated(box(source.in(0.5, 2), source.in(0.5, 2), thin), source.in(0, 3)),
                         {source.in(-0.5, 0.5), source.in(-0.5, 0.5), source.in(-0.5, 0.5)});
        };
        check_both_ways({make(), make()}, quick::perhaps);  // edges of four faces
    }
}

TEST_CASE("sound operands: where rounding breaks something, the general way mends it") {
    // A ball against itself, moved by less than rounding keeps apart.
    const operands pair{rotated(ball(3, 1.0), 0.7),
                        moved(rotated(ball(3, 1.0), 0.7), {1e-15, 0, 0})};
    const tf::solid_result general = evaluate(pair, "a+b", {});
    const tf::solid_result quick = evaluate(pair, "a+b", {.sound_operands = true});
    CHECK(quick.certified == general.certified);
    CHECK(quick.surface == general.surface);
    const tf::solid_result floats =
        evaluate(pair, "a*b", {.to_float = true, .sound_operands = true});
    CHECK(floats.surface == evaluate(pair, "a*b", {.to_float = true}).surface);
}

TEST_CASE("sound operands: points that no face uses may be anything, bad ones are refused") {
    operands pair{ball(3, 1.0), moved(ball(3, 1.0), {0.5, 0, 0})};
    const tf::solid_result before = evaluate(pair, "a+b", {.sound_operands = true});
    pair[0].points.push_back({NAN, 0, 0});
    pair[1].points.push_back({1e9, 0, 0});
    const tf::solid_result after = evaluate(pair, "a+b", {.sound_operands = true});
    CHECK(after.surface == before.surface);
    CHECK(after.source_point == before.source_point);
    pair[0].points[7].y = INFINITY;
    CHECK_THROWS_AS(static_cast<void>(evaluate(pair, "a+b", {.sound_operands = true})),
                    std::invalid_argument);
    pair[0].faces[3][1] = 1'000'000;
    CHECK_THROWS_AS(static_cast<void>(evaluate(pair, "a+b", {.sound_operands = true})),
                    std::invalid_argument);
}

TEST_CASE("sound operands: what is not sound at sight goes the general way") {
    tf::mesh soup;  // corners of its own for each face
    for (const tf::face& f : ball(2, 1.0).faces)
        for (const std::uint32_t corner : f) soup.points.push_back(ball(2, 1.0).points[corner]);
    for (std::uint32_t i = 0; i < soup.points.size(); i += 3)
        soup.faces.push_back({i, i + 1, i + 2});
    check_both_ways({soup, moved(ball(3, 1.0), {0.3, 0.2, 0.1})}, quick::never);
}

TEST_CASE("sound operands: the same bytes on any number of threads, and progress can say stop") {
    const operands pair{ball(5, 1.0), moved(rotated(ball(5, 1.0), 0.3), {0.4, 0.3, 0.2})};
    const tf::solid_result all = evaluate(pair, "a-b", {.sound_operands = true});
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        const tf::solid_result result = evaluate(pair, "a-b", {.sound_operands = true});
        CHECK(result.surface == all.surface);
        CHECK(result.source_face == all.source_face);
        CHECK(result.source_point == all.source_point);
    }
    for (const double limit : {0.0, 0.3, 0.5, 0.7}) {
        const tf::solid_result stopped = evaluate(
            pair, "a-b",
            {.sound_operands = true, .progress = [&](double done) { return done < limit; }});
        CHECK(stopped.cancelled);
        CHECK(stopped.surface.faces.empty());
    }
}
