/// \file
/// Repair: what is certified, what is inside, what stays as it was.

#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/intersect/point_locator.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/repaired.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace {

using test::two_balls;

using mode = tf::resolve_mode;

double area_of(const tf::mesh& mesh) {
    double sum = 0.0;
    for (const tf::face& f : mesh.faces) {
        const tf::point3 &a = mesh.points[f[0]], &b = mesh.points[f[1]], &c = mesh.points[f[2]];
        const tf::point3 u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z};
        sum +=
            0.5 * std::hypot(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
    }
    return sum;
}

/// How many of some random points are inside of `solid` and not where `mesh` winds around them as
/// the rule says, or the other way round.
std::size_t wrong_points(const tf::mesh& mesh, tf::fill_rule rule, const tf::mesh& solid,
                         std::size_t count) {
    test::random source(3);
    const tf::tree<3> tree = tf::build_face_tree(mesh), solid_tree = tf::build_face_tree(solid);
    const tf::detail::intersect::point_locator before(mesh, tree), after(solid, solid_tree);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const tf::point3 p{source.in(-1.2, 2.0), source.in(-1.2, 1.6), source.in(-1.2, 1.4)};
        const auto was = before.locate(p);
        const auto is = after.locate(p);
        const bool inside = rule == tf::fill_rule::even_odd   ? was.winding % 2 != 0
                            : rule == tf::fill_rule::positive ? was.winding > 0
                                                              : was.winding != 0;
        wrong += is.winding != (inside ? 1 : 0);
    }
    return wrong;
}

}  // namespace

TEST_CASE("repair: the outer surface of two balls bounds what either held") {
    const tf::mesh mesh = two_balls();
    for (const tf::fill_rule rule :
         {tf::fill_rule::nonzero, tf::fill_rule::even_odd, tf::fill_rule::positive})
        for (const bool to_float : {false, true}) {
            CAPTURE(static_cast<int>(rule));
            CAPTURE(to_float);
            const auto result = tf::resolve_self_intersections(
                mesh, mode::outer,
                {.fill_rule = rule,
                 .precision = to_float ? tf::precision::float32 : tf::precision::float64});
            CHECK(result.certificate);
            CHECK(result.certificate.meeting.empty());
            CHECK(tf::self_intersections(result.mesh).pairs.empty());
            CHECK(!tf::find_open_edge(result.mesh));
            CHECK(result.certificate.max_displacement < (to_float ? 1e-6 : 1e-15));
            CHECK(result.statistics.vanished_components == 0);
            if (!to_float) CHECK(wrong_points(mesh, rule, result.mesh, 2000) == 0);
        }
}

TEST_CASE("repair: faces that meet nothing come out bit for bit and in order") {
    const tf::mesh mesh = two_balls();
    std::vector<char> meets(mesh.faces.size());
    for (const tf::face_pair& pair : tf::self_intersections(mesh).pairs)
        meets[pair.a] = meets[pair.b] = 1;
    for (const mode m : {mode::split, mode::outer}) {
        const auto result = tf::resolve_self_intersections(mesh, m);
        REQUIRE(result.face_source.size() == result.mesh.faces.size());
        CHECK(std::is_sorted(result.face_source.begin(), result.face_source.end()));
        std::size_t same = 0;
        for (std::size_t f = 0; f < result.face_source.size(); ++f) {
            const std::uint32_t old = result.face_source[f];
            if (meets[old] != 0) continue;
            ++same;
            for (std::size_t k = 0; k < 3; ++k)
                CHECK(result.mesh.points[result.mesh.faces[f][k]] ==
                      mesh.points[mesh.faces[old][k]]);
        }
        CHECK(same > 0);
        if (m == mode::split) CHECK(same == static_cast<std::size_t>(std::ranges::count(meets, 0)));
        for (std::size_t p = 0; p < result.vertex_source.size(); ++p)
            if (result.vertex_source[p] != tf::repair_result::none)
                CHECK(result.mesh.points[p] == mesh.points[result.vertex_source[p]]);
    }
}

TEST_CASE("repair: splitting keeps every face") {
    test::random source(4);
    for (const tf::mesh& mesh : {two_balls(), test::random_soup(source, 60, 0.4)}) {
        const auto result = tf::resolve_self_intersections(mesh, mode::split);
        CHECK(result.certificate);
        CHECK(tf::self_intersections(result.mesh).pairs.empty());
        CHECK(area_of(result.mesh) == doctest::Approx(area_of(mesh)).epsilon(1e-12));
        CHECK(result.statistics.removed == 0);
        CHECK(result.statistics.filled == 0);
        CHECK(result.statistics.message().ends_with(" pairs cut"));
    }
}

TEST_CASE("repair: a surface with a border bounds nothing, and it is said where it ends") {
    tf::mesh mesh = two_balls();
    mesh.faces.erase(mesh.faces.begin() + 5);
    const auto result = tf::resolve_self_intersections(mesh);
    CHECK(!result.certificate);
    CHECK(result.mesh.faces.empty());
    CHECK(result.certificate.open_count == 3);
    REQUIRE(result.certificate.open_edges.size() == 3);
    CHECK(tf::resolve_self_intersections(mesh, mode::split).certificate);
}

TEST_CASE("repair: a point that no face has may be anything, and changes nothing") {
    const tf::mesh ball = test::ball(2, 1.0);
    for (const double x : {1e300, 1e6 + 0.1, std::numeric_limits<double>::quiet_NaN()})
        for (const mode m : {mode::split, mode::outer, mode::remove})
            for (const bool to_float : {false, true}) {
                tf::mesh more = ball;
                more.points.push_back({x, 0.0, 0.0});
                const auto result = tf::resolve_self_intersections(
                    more, m,
                    {.precision = to_float ? tf::precision::float32 : tf::precision::float64});
                const auto expected = tf::resolve_self_intersections(
                    ball, m,
                    {.precision = to_float ? tf::precision::float32 : tf::precision::float64});
                CHECK(result.certificate);
                CHECK(result.mesh == expected.mesh);
                CHECK(result.certificate.max_displacement == expected.certificate.max_displacement);
            }
}

TEST_CASE("repair: what cannot be meant is refused") {
    for (const mode m : {mode::split, mode::outer, mode::remove})
        for (const bool to_float : {false, true}) {
            tf::mesh mesh = test::box(1, 1, 1);
            mesh.points[3].x = std::numeric_limits<double>::quiet_NaN();
            CHECK_THROWS_AS(
                static_cast<void>(tf::resolve_self_intersections(
                    mesh, m,
                    {.precision = to_float ? tf::precision::float32 : tf::precision::float64})),
                std::invalid_argument);
            mesh.points[3].x = 1e300;  // beyond the range of float
            mesh.faces[5][1] = 8;
            CHECK_THROWS_AS(
                static_cast<void>(tf::resolve_self_intersections(
                    mesh, m,
                    {.precision = to_float ? tf::precision::float32 : tf::precision::float64})),
                std::invalid_argument);
        }
}

TEST_CASE("repair: what is removed and filled does not depend on the unit") {
    tf::mesh mesh = test::ball(4, 1.0);
    mesh.points[4] = {0.03, 0.02, -1.5};
    const auto expected = tf::resolve_self_intersections(mesh, mode::remove);
    REQUIRE(expected.certificate);
    for (const double size : {0x1p520, 0x1p1020, 0x1p-520, 0x1p-960}) {
        const auto result = tf::resolve_self_intersections(test::scaled(mesh, size), mode::remove);
        CHECK(result.certificate);
        CHECK(result.mesh.faces == expected.mesh.faces);
    }
}

TEST_CASE("repair: progress never goes back, and can stop it in any round") {
    const tf::mesh mesh = two_balls();
    for (const mode m : {mode::split, mode::outer, mode::remove}) {
        double last = 0.0;
        std::size_t calls = 0;
        bool forward = true;
        const auto whole = tf::resolve_self_intersections(
            mesh, m, {.max_loss = 1.0, .progress = [&](double done) {
                          forward = forward && done >= last && done <= 1.0;
                          last = done;
                          ++calls;
                          return true;
                      }});
        CHECK(whole.certificate);
        CHECK(forward);
        for (std::size_t limit = 0; limit < calls; limit += 1 + calls / 20) {
            std::size_t left = limit;
            const auto stopped = tf::resolve_self_intersections(
                mesh, m, {.progress = [&](double) { return left > 0 && left-- > 0; }});
            CHECK(stopped.certificate.status == tf::status::cancelled);
            CHECK(!stopped.certificate);
        }
    }
}

TEST_CASE("repair: nothing to repair, nothing changed; on any number of threads") {
    const tf::mesh ball = test::ball(2, 1.0);
    for (const mode m : {mode::split, mode::outer, mode::remove}) {
        const auto same = tf::resolve_self_intersections(ball, m);
        CHECK(same.mesh == ball);
        CHECK(same.statistics.message().empty());
        CHECK(tf::resolve_self_intersections(tf::mesh{}, m).certificate);
        const auto all = tf::resolve_self_intersections(two_balls(), m);
        for (const unsigned threads : {1U, 2U, 8U}) {
            const tf::thread_scope scope(threads);
            const auto again = tf::resolve_self_intersections(two_balls(), m);
            CHECK(again.mesh == all.mesh);
            CHECK(again.face_source == all.face_source);
        }
    }
}

TEST_CASE("resolve: what loses too much is not certified") {
    tf::mesh dirty = test::box(10, 10, 10);  // the edge from 0 to 1 has a vertex and a needle
    dirty.points.push_back({5, 0, 0});
    dirty.faces[0] = {0, 2, 8};
    dirty.faces.insert(dirty.faces.end(), {{2, 1, 8}, {0, 8, 1}});
    const tf::repair_result lost = tf::resolve_self_intersections(dirty, mode::remove);
    if (tf::signed_volume(lost.mesh) < 950) {
        CHECK(lost.certificate.status == tf::status::excessive_loss);
        CHECK(lost.certificate.size_is_volume);
        CHECK(lost.certificate.size_before == doctest::Approx(1000));
        CHECK(lost.certificate.size_after == doctest::Approx(tf::signed_volume(lost.mesh)));
        CHECK_THROWS_AS((void)lost.value(), tf::not_certified_error);
    }
    const tf::repair_result allowed =
        tf::resolve_self_intersections(dirty, mode::remove, {.max_loss = 1.0});
    CHECK(allowed.certificate);
    CHECK(allowed.mesh == lost.mesh);
    CHECK_THROWS_AS((void)tf::resolve_self_intersections(dirty, mode::remove, {.max_loss = -1.0}),
                    std::invalid_argument);
}

TEST_CASE("resolve: an inward body that cancels another one is a loss, an inverted solid is none") {
    const tf::mesh ball = test::ball(3, 1.0);
    tf::mesh turned = ball;
    for (tf::face& f : turned.faces) std::swap(f[1], f[2]);
    CHECK(tf::resolve_self_intersections(turned).certificate);
    const tf::mesh pair = test::together(ball, test::moved(turned, {0.5, 0.1, 0.2}));
    const tf::repair_result lost = tf::resolve_self_intersections(pair);
    CHECK(lost.certificate.status == tf::status::excessive_loss);
    CHECK(lost.certificate.size_after < 0.95 * lost.certificate.size_before);
    CHECK(tf::resolve_self_intersections(pair, mode::outer, {.max_loss = 1.0}).certificate);
    // A cavity is meant.
    tf::mesh hollow = test::ball(2, 0.5);
    for (tf::face& f : hollow.faces) std::swap(f[1], f[2]);
    CHECK(tf::resolve_self_intersections(test::together(ball, hollow)).certificate);
}
