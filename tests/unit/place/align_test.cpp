#include <treeform/mesh/align.hpp>
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/models.hpp>
#include <support/random.hpp>
#include <support/scans.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

using tf::align_method;
using tf::point3;

/// A shape that no motion brings onto itself: boxes of three sizes.
tf::mesh three_boxes() {
    return test::together(
        test::together(test::box(3, 2, 1), test::moved(test::box(1, 1, 2), {0.3, 0.4, 1})),
        test::moved(test::box(0.5, 1.5, 1), {2.2, 0.3, 1}));
}

/// Points on its faces, at random.
std::vector<point3> points_on(test::random& source, const tf::mesh& mesh, std::size_t count) {
    std::vector<point3> points;
    for (std::size_t i = 0; i < count; ++i) {
        const tf::face& f = mesh.faces[source.below(mesh.faces.size())];
        double u = source.unit(), v = source.unit();
        if (u + v > 1.0) {
            u = 1.0 - u;
            v = 1.0 - v;
        }
        const point3 &a = mesh.points[f[0]], &b = mesh.points[f[1]], &c = mesh.points[f[2]];
        point3 p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]);
        points.push_back(p);
    }
    return points;
}

/// A turn by `angle` about (x, y, z) of length 1, growth by `scale`, then a shift.
tf::transform<3> motion(double angle, double scale, const point3& shift) {
    const double x = 2.0 / 7, y = 3.0 / 7, z = 6.0 / 7, c = std::cos(angle), s = std::sin(angle);
    tf::transform<3> m;
    m.rows = {{{c + x * x * (1 - c), x * y * (1 - c) - z * s, x * z * (1 - c) + y * s, shift.x},
               {y * x * (1 - c) + z * s, c + y * y * (1 - c), y * z * (1 - c) - x * s, shift.y},
               {z * x * (1 - c) - y * s, z * y * (1 - c) + x * s, c + z * z * (1 - c), shift.z}}};
    for (auto& row : m.rows)
        for (std::size_t k = 0; k < 3; ++k) row[k] *= scale;
    return m;
}

std::vector<point3> moved(std::vector<point3> points, const tf::transform<3>& by) {
    for (point3& p : points) p = by(p);
    return points;
}

double distance(const point3& a, const point3& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

double largest_difference(const std::vector<point3>& a, const std::vector<point3>& b) {
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, distance(a[i], b[i]));
    return most;
}

}  // namespace

TEST_CASE("align: a known motion is found to the last digits, on planes and on points") {
    test::random source(1);
    const tf::mesh fixed = three_boxes();
    const std::vector<point3> home = points_on(source, fixed, 3000);
    for (int round = 0; round < 6; ++round) {
        CAPTURE(round);
        const auto away =
            motion(source.in(-0.1, 0.1), 1.0, {source.in(-0.1, 0.1), source.in(-0.1, 0.1), 0.05});
        const std::vector<point3> there = moved(home, away);
        const auto on_planes = tf::align(there, fixed);
        CHECK(on_planes.converged);
        CHECK(largest_difference(moved(there, on_planes.matrix), home) < 1e-12);
        CHECK(on_planes.rms < 1e-12);
        CHECK(on_planes.rms_at_start > 1e-3);
        CHECK(on_planes.overlap == 1.0);
        CHECK(on_planes.iterations < 80);
        CHECK(on_planes.scale == 1.0);
        CHECK(distance(on_planes.matrix(on_planes.pivot), on_planes.pivot_moved) < 1e-14);
        // a cloud, so near that most points have the right partner
        const std::vector<point3> near = moved(home, motion(0.004, 1.0, {0.004, -0.002, 0.003}));
        const auto on_points = tf::align(near, home);
        CHECK(on_points.converged);
        CHECK(largest_difference(moved(near, on_points.matrix), home) < 1e-12);
    }
}

TEST_CASE("align: a third of the points are somewhere else, and are trimmed") {
    test::random source(2);
    const tf::mesh fixed = three_boxes();
    for (int round = 0; round < 4; ++round) {
        std::vector<point3> home = points_on(source, fixed, 2000);
        const auto away = motion(0.06, 1.0, {0.05, -0.06, 0.04});
        std::vector<point3> there = moved(home, away);
        const std::size_t good = there.size();
        for (std::size_t i = 0; i < good * 3 / 7; ++i)
            there.push_back({source.in(-2, 5), source.in(-2, 4), source.in(4, 6)});
        source.shuffle(there);
        const auto found = tf::align(there, fixed, {.overlap = 0.7});
        CHECK(found.converged);
        CHECK(largest_difference(moved(moved(home, away), found.matrix), home) < 1e-12);
        CHECK(found.rms < 1e-12);
        // or by their distance
        const auto near = tf::align(there, fixed, {.max_distance = 0.5});
        CHECK(largest_difference(moved(moved(home, away), near.matrix), home) < 1e-10);
        CHECK(near.overlap == doctest::Approx(0.7).epsilon(0.01));
        // with all of them it is another place
        const auto all = tf::align(there, fixed, {.robust = false});
        CHECK(largest_difference(moved(moved(home, away), all.matrix), home) > 1e-3);
    }
}

TEST_CASE("align: far from the origin as well as the coordinates there allow, and in any unit") {
    test::random source(3);
    const point3 offset{1e6, -2e6, 1e6};
    const tf::mesh fixed = test::moved(three_boxes(), offset);
    const std::vector<point3> home = points_on(source, fixed, 3000);
    const auto about = [&](const tf::transform<3>& m) {
        return tf::transform<3>::translation(offset).after(
            m.after(tf::transform<3>::translation(point3{-offset.x, -offset.y, -offset.z})));
    };
    const std::vector<point3> there = moved(home, about(motion(0.08, 1.0, {0.1, -0.05, 0.06})));
    const auto found = tf::align(there, fixed);
    CHECK(found.converged);
    CHECK(largest_difference(moved(there, found.matrix), home) < 4e-9);
    // the turn, which no large numbers are part of
    const auto expected = motion(-0.08, 1.0, {});
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
            CHECK(std::abs(found.matrix.rows[r][c] - expected.rows[r][c]) < 1e-9);

    const tf::mesh near = three_boxes();
    const std::vector<point3> points = points_on(source, near, 500);
    const std::vector<point3> off = moved(points, motion(0.05, 1.0, {0.1, 0.1, 0.1}));
    const auto plain = tf::align(off, near);
    for (const double unit : {0x1p-300, 0x1p300}) {
        std::vector<point3> scaled = off;
        for (point3& p : scaled) p = {p.x * unit, p.y * unit, p.z * unit};
        const auto other = tf::align(scaled, test::scaled(near, unit));
        CHECK(other.matrix.rows[0][0] == plain.matrix.rows[0][0]);
        CHECK(other.matrix.rows[1][3] == plain.matrix.rows[1][3] * unit);
    }
}

TEST_CASE("align: a uniform scale is found when it is asked for, and only then") {
    test::random source(4);
    const tf::mesh fixed = three_boxes();
    const std::vector<point3> home = points_on(source, fixed, 2000);
    const std::vector<point3> there = moved(home, motion(0.03, 1.03, {0.02, 0.01, -0.02}));
    const auto found = tf::align(there, fixed, {.scale = true});
    CHECK(found.scale == doctest::Approx(1.0 / 1.03).epsilon(1e-12));
    CHECK(largest_difference(moved(there, found.matrix), home) < 1e-12);
    CHECK(tf::align(there, fixed).scale == 1.0);
    const std::vector<point3> cloud = moved(home, motion(0.003, 1.002, {0.002, 0.001, 0.002}));
    const auto points = tf::align(cloud, home, {.scale = true});
    CHECK(largest_difference(moved(cloud, points.matrix), home) < 1e-12);
}

TEST_CASE("align: a start brings the points near, and is part of the matrix, mirrored or not") {
    test::random source(5);
    const tf::mesh fixed = three_boxes();
    const std::vector<point3> home = points_on(source, fixed, 1000);
    tf::transform<3> start = motion(2.0, 1.0, {50, 60, -70});
    for (double& entry : start.rows[1]) entry = -entry;
    // what start nearly brings home: its inverse is the transposed
    const auto nearly = moved(home, motion(0.03, 1.0, {0.02, 0.03, 0.01}));
    std::vector<point3> there;
    for (const point3& p : nearly) {
        const point3 d{p.x - start.rows[0][3], p.y - start.rows[1][3], p.z - start.rows[2][3]};
        point3 q;
        for (std::size_t k = 0; k < 3; ++k)
            q[k] = start.rows[0][k] * d.x + start.rows[1][k] * d.y + start.rows[2][k] * d.z;
        there.push_back(q);
    }
    const auto found = tf::align(there, fixed, {.start = start});
    CHECK(found.converged);
    CHECK(largest_difference(moved(there, found.matrix), home) < 1e-11);
}

TEST_CASE("align: never worse than the start, whatever is fitted to what") {
    test::random source(6);
    for (int round = 0; round < 40; ++round) {
        CAPTURE(round);
        const tf::mesh fixed = round % 2 == 0 ? test::random_soup(source, 20, 0.3)
                                              : test::lattice_soup(source, 20, 12, 3);
        std::vector<point3> there;
        for (int i = 0; i < 60; ++i)
            there.push_back({source.in(-2, 3), source.in(-2, 3), source.in(-2, 3)});
        tf::align_options options;
        options.method = static_cast<align_method>(source.below(3));
        options.overlap = std::min(source.in(0.2, 1.8), 1.0);
        options.robust = false;
        options.max_samples = round % 3 == 0 ? 20 : 0;
        options.max_iterations = static_cast<unsigned>(source.below(30));
        const auto found = tf::align(there, fixed, options);
        // a trimmed set is also weighted, and rms is not
        CHECK(found.rms <= found.rms_at_start * (options.overlap < 1.0 ? 1.1 : 1.0));
        CHECK(found.iterations <= options.max_iterations);
        // what is said of it is what one finds there
        const auto again = tf::align(there, fixed,
                                     {.overlap = options.overlap,
                                      .robust = options.robust,
                                      .max_iterations = 0,
                                      .start = found.matrix});
        CHECK(again.rms_at_start == doctest::Approx(found.rms).epsilon(1e-9));
    }
}

TEST_CASE("align: flat on flat slides nowhere, and a mirror image is not mirrored") {
    test::random source(7);
    const tf::mesh sheet = test::grid(8);
    std::vector<point3> there;
    for (int i = 0; i < 200; ++i) there.push_back({source.in(2, 6), source.in(2, 6), 0.25});
    const auto found = tf::align(there, sheet);
    CHECK(found.converged);
    CHECK(found.rms < 1e-14);
    for (const point3& p : there) CHECK(distance(found.matrix(p), {p.x, p.y, 0.0}) < 1e-13);

    const std::vector<point3> cloud{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {0, 0, 1}};
    std::vector<point3> mirrored = cloud;
    for (point3& p : mirrored) p.z = -p.z;
    const auto m = tf::align(mirrored, cloud).matrix.rows;
    const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    CHECK(determinant == doctest::Approx(1.0));
}

TEST_CASE("align: nothing, one point, and what is there already") {
    const tf::mesh fixed = three_boxes();
    const auto none = tf::align(tf::points_view{}, fixed);
    CHECK_FALSE(none.converged);
    CHECK(none.matrix == tf::transform<3>{});
    CHECK_FALSE(tf::align(fixed.points, tf::mesh{}).converged);
    const std::vector<point3> one{{5, 5, 5}};
    CHECK(tf::align(one, fixed).rms < 1e-12);
    const auto there = tf::align(fixed.points, fixed);
    CHECK(there.converged);
    CHECK(there.rms == 0.0);
    CHECK(there.matrix == tf::transform<3>{});
    const auto out_of_reach = tf::align(one, fixed, {.max_distance = 1e-3});
    CHECK(out_of_reach.overlap == 0.0);
    CHECK_FALSE(out_of_reach.converged);
}

TEST_CASE("align: the same on any number of threads") {
    test::random source(8);
    const tf::mesh fixed = three_boxes();
    const std::vector<point3> there =
        moved(points_on(source, fixed, 20000), motion(0.05, 1.0, {0.1, 0, 0.1}));
    const auto one = tf::align(there, fixed, {.overlap = 0.9});
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        const auto other = tf::align(there, fixed, {.overlap = 0.9});
        CHECK(other.matrix == one.matrix);
        CHECK(other.rms == one.rms);
    }
}

TEST_CASE("align: what cannot be meant is refused") {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    tf::mesh fixed = three_boxes();
    std::vector<point3> there = fixed.points;
    const auto refused = [&](const tf::align_options& o) {
        CHECK_THROWS_AS(static_cast<void>(tf::align(there, fixed, o)), std::invalid_argument);
    };
    refused({.overlap = 0.0});
    refused({.overlap = 1.5});
    refused({.overlap = nan});
    refused({.max_distance = -1.0});
    refused({.tolerance = nan});
    refused({.starts = 0});
    refused({.least_scale = -1.0});
    refused({.least_scale = nan});
    refused({.least_scale = std::numeric_limits<double>::infinity()});
    refused({.most_scale = 0.0});
    refused({.most_scale = nan});
    refused({.least_scale = 2.0, .most_scale = 1.0});
    tf::align_options start;
    start.start.rows[0][0] = nan;
    refused(start);
    there[4].x = 1e200;
    CHECK_THROWS_WITH_AS(static_cast<void>(tf::align(there, fixed)), doctest::Contains("too large"),
                         std::overflow_error);
    there[4].x = nan;
    CHECK_THROWS_WITH_AS(static_cast<void>(tf::align(there, fixed)),
                         doctest::Contains("moving point 4"), std::invalid_argument);
}

TEST_CASE("align: a noisy scan converges, and again from its own answer") {
    test::random source(9);
    const tf::mesh solid = three_boxes();
    for (const double noise : {1e-5, 1e-4, 1e-3})
        for (const auto method : {align_method::point_to_plane, align_method::point_to_point}) {
            CAPTURE(noise);
            const auto scan =
                test::scan_of(solid, {.points = 4000, .noise = noise, .degrees = 8}, source);
            const auto found = tf::align(scan.moving, scan.fixed, {.method = method});
            CHECK(found.outcome == tf::align_outcome::converged);
            CHECK(test::error_of(scan, found.matrix, false) < noise);
            CHECK(found.inliers > 3900);
            CHECK(std::abs(found.correlation) < 0.15);
            const auto again =
                tf::align(scan.moving, scan.fixed, {.method = method, .start = found.matrix});
            CHECK(again.converged);
            // the weights are as wide as the distances at the start
            CHECK(again.rms == doctest::Approx(found.rms).epsilon(0.1));
            CHECK(test::error_of(scan, again.matrix, false) < noise);
        }
}

TEST_CASE("align: a tolerance of 0 asks for a pose that does not move, a large one for little") {
    test::random source(10);
    const auto scan = test::scan_of(three_boxes(), {.noise = 1e-4, .degrees = 8}, source);
    const auto usual = tf::align(scan.moving, scan.fixed);
    const auto coarse = tf::align(scan.moving, scan.fixed, {.tolerance = 0.5});
    CHECK(coarse.iterations <= usual.iterations);
    const auto exact = tf::align(scan.moving, scan.fixed, {.tolerance = 0.0});
    CHECK(exact.rms <= usual.rms * (1.0 + 1e-12));
    const auto none = tf::align(scan.moving, scan.fixed, {.max_iterations = 0});
    CHECK(none.outcome == tf::align_outcome::out_of_iterations);
    CHECK(none.iterations == 0);
    CHECK(none.matrix == tf::transform<3>{});
}

TEST_CASE("align: acceleration takes fewer steps from points to points, to the same place") {
    test::random source(11);
    unsigned with = 0, without = 0;
    for (int round = 0; round < 5; ++round) {
        const auto scan = test::scan_of(three_boxes(), {.noise = 1e-4, .degrees = 6}, source);
        tf::align_options options{.method = align_method::point_to_point, .max_iterations = 1000};
        const auto fast = tf::align(scan.moving, scan.fixed, options);
        options.accelerate = false;
        const auto plain = tf::align(scan.moving, scan.fixed, options);
        CHECK(fast.converged);
        CHECK(largest_difference(moved(scan.moving, fast.matrix),
                                 moved(scan.moving, plain.matrix)) < 1e-3);
        with += fast.iterations;
        without += plain.iterations;
    }
    CHECK(with < without);
}

TEST_CASE("align: what has no partner is found by weights, trimmed by its share, or a doubt") {
    test::random source(12);
    for (int round = 0; round < 3; ++round) {
        const auto scan = test::scan_of(
            three_boxes(),
            {.noise = 1e-5, .degrees = 8, .share = 0.6, .what = test::scanned::part_of_fixed},
            source);
        const auto weighed = tf::align(scan.moving, scan.fixed);
        CHECK(weighed.converged);
        CHECK(test::error_of(scan, weighed.matrix, false) < 1e-5);
        const tf::align_options equal{.robust = false};
        CHECK(tf::align(scan.moving, scan.fixed, equal).outcome == tf::align_outcome::doubtful);
        // a share that is too large does no harm, either
        for (const double overlap : {0.5, 0.6, 0.62}) {
            const auto trimmed = tf::align(scan.moving, scan.fixed, {.overlap = overlap});
            if (trimmed.converged) CHECK(test::error_of(scan, trimmed.matrix, false) < 1e-5);
            if (overlap <= 0.6) CHECK(trimmed.converged);
        }
    }
}

TEST_CASE("align: several starts find what is turned any way, the present one first of equals") {
    test::random source(13);
    for (const double degrees : {90.0, 135.0, 180.0}) {
        CAPTURE(degrees);
        const auto scan = test::scan_of(three_boxes(), {.noise = 1e-5, .degrees = degrees}, source);
        if (const auto once = tf::align(scan.moving, scan.fixed); once.converged)
            CHECK(test::error_of(scan, once.matrix, false) < 1e-5);
        for (const unsigned starts : {5U, 60U}) {
            const auto found = tf::align(scan.moving, scan.fixed, {.starts = starts});
            CHECK(found.converged);
            CHECK(found.best_start > 0);
            CHECK(found.best_start < starts);
            CHECK(test::error_of(scan, found.matrix, false) < 1e-5);
        }
    }
    const auto near = test::scan_of(three_boxes(), {.degrees = 2}, source);
    CHECK(tf::align(near.moving, near.fixed, {.starts = 20}).best_start == 0);
}

TEST_CASE(
    "align: the motions that nothing holds: of a plane three, of a ball three, of a prism one") {
    test::random source(14);
    const auto free_of = [&](const tf::mesh& fixed) {
        const auto found = tf::align(test::spread_over(source, fixed, 2000), fixed);
        CHECK(found.freedoms.size() == 6);
        for (const tf::align_freedom& one : found.freedoms) {
            CHECK(one.stiffness >= 0.0);
            CHECK(one.stiffness <= 1.0);
        }
        return found;
    };
    const auto flat = free_of(test::grid(8));
    CHECK(flat.undetermined() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(std::abs(flat.freedoms[i].shift.z) < 1e-12);
        CHECK(std::abs(flat.freedoms[i].turn.x) + std::abs(flat.freedoms[i].turn.y) < 1e-12);
    }
    CHECK(flat.freedoms[5].stiffness == doctest::Approx(1.0));
    CHECK(free_of(three_boxes()).undetermined() == 0);
    // without its ends, a bar slides along itself
    tf::mesh bar = test::box(1, 2, 9);
    std::erase_if(bar.faces, [&](const tf::face& f) {
        return bar.points[f[0]].z == bar.points[f[1]].z && bar.points[f[0]].z == bar.points[f[2]].z;
    });
    const auto slides = free_of(bar);
    REQUIRE(slides.undetermined() == 1);
    CHECK(std::abs(slides.freedoms[0].shift.z) == doctest::Approx(1.0));
    // points on a line show no turn about it
    std::vector<point3> line;
    for (int i = 0; i < 20; ++i) line.push_back({0.1 * i, 0, 0});
    CHECK(tf::align(line, test::grid(8)).freedoms.size() == 5);
}

TEST_CASE("align: clouds to planes fitted to clouds, the same points thousands of times") {
    test::random source(15);
    const tf::mesh solid = three_boxes();
    std::vector<point3> fixed = points_on(source, solid, 20000);
    const std::vector<point3> home = points_on(source, solid, 3000);
    for (int i = 0; i < 3000; ++i) fixed.push_back({0, 0, 0});
    const auto there = moved(home, motion(0.03, 1.0, {0.02, -0.03, 0.01}));
    const auto planes =
        tf::align(there, fixed, {.method = align_method::point_to_plane, .overlap = 0.95});
    CHECK(planes.converged);
    CHECK(largest_difference(moved(there, planes.matrix), home) < 0.01);
    const auto points = tf::align(there, fixed);
    CHECK(points.converged);
    CHECK(largest_difference(moved(there, points.matrix), home) < 0.02);
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        CHECK(tf::align(there, fixed).matrix == points.matrix);
    }
}

TEST_CASE("align: of scans of real solids, right places converge and wrong ones never do") {
    NEEDS_MODELS();
    const std::filesystem::path folder = test::models_folder();
    test::random source(16);
    // A sample; all of it: tests/stress/align_stress.cpp.
    for (const char* file : {"decimated_knight_1k.off", "fertility_9k.off", "fish_2k.obj"}) {
        CAPTURE(file);
        const tf::mesh solid = tf::as_mesh(tf::read(folder / "clean" / file)).mesh;
        for (const double noise : {0.0, 1e-5, 1e-4, 1e-3})
            for (const double degrees : {5.0, 30.0})
                for (const bool whole : {true, false}) {
                    CAPTURE(noise);
                    CAPTURE(degrees);
                    const auto scan = test::scan_of(
                        solid,
                        {.points = 1000,
                         .noise = noise,
                         .degrees = degrees,
                         .share = whole ? 1.0 : 0.6,
                         .what = whole ? test::scanned::all : test::scanned::part_of_fixed},
                        source);
                    const auto found =
                        tf::align(scan.moving, scan.fixed, {.overlap = whole ? 1.0 : 0.6});
                    const double error = test::error_of(scan, found.matrix, false);
                    if (error <= std::max(noise, 1e-9)) CHECK(found.converged);
                    if (error > 3.0 * std::max(noise, 1e-9)) CHECK_FALSE(found.converged);
                }
    }
}
