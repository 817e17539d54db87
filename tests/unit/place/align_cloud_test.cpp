#include <treeform/mesh/align.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/scans.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace {

using tf::point3;

/// A hall of 24 by 16 by 6 with boxes in it, its floor at 0.
tf::mesh hall() {
    tf::mesh room = test::moved(test::box(24, 16, 6), {-12, -8, 0});
    for (const point3& at : {point3{-9, -5, 0}, point3{4, 3, 0}, point3{7, -6, 0}})
        room = test::together(room, test::moved(test::box(2, 1.5, 2.5), at));
    return room;
}

/// What a scanner there sees, with its own place as the origin: on rings, dense around the scanner
/// and far apart further away.
std::vector<point3> sweep(const tf::mesh& room, const point3& from, double noise,
                          test::random& source) {
    std::vector<tf::ray3> rays;
    for (int ring = 0; ring < 32; ++ring)
        for (int step = 0; step < 600; ++step) {
            const double up = (-25.0 + 1.3 * ring) * std::numbers::pi / 180.0;
            const double around = step * std::numbers::pi / 300.0;
            rays.push_back(
                {{from.x, from.y, from.z},
                 {std::cos(up) * std::cos(around), std::cos(up) * std::sin(around), std::sin(up)}});
        }
    std::vector<point3> seen;
    const auto hits = tf::raycast(room, rays);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (!hits[i]) continue;
        point3& p = seen.emplace_back();
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = hits[i]->t * rays[i].direction[k] + noise * test::gaussian(source);
    }
    return seen;
}

/// How far a motion takes the points from where they belong: root mean square.
double off_by(const std::vector<point3>& points, const tf::transform<3>& found,
              const tf::transform<3>& right) {
    double sum = 0.0;
    for (const point3& p : points) {
        const point3 a = found(p), b = right(p);
        sum += (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z);
    }
    return std::sqrt(sum / static_cast<double>(points.size()));
}

/// Boxes of three sizes: no motion brings them onto themselves.
tf::mesh three_sizes() {
    return test::together(
        test::together(test::box(3, 2, 1), test::moved(test::box(1, 1, 2), {0.3, 0.4, 1})),
        test::moved(test::box(0.5, 1.5, 1), {2.2, 0.3, 1}));
}

}  // namespace

TEST_CASE("align: the rings around a scanner do not hold it where it was") {
    const tf::mesh room = hall();
    test::random source(1);
    for (const double way : {0.5, 1.0, 2.0}) {
        CAPTURE(way);
        const point3 first{0, 0, 1.8}, second{0.9 * way, 0.4 * way, 1.8};
        std::vector<point3> fixed = sweep(room, first, 0.01, source);
        std::vector<point3> moving = sweep(room, second, 0.01, source);
        // what is not seen is at the origin
        fixed.resize(fixed.size() + 2000);
        moving.resize(moving.size() + 2000);
        const auto right =
            tf::transform<3>::translation(point3{second.x - first.x, second.y - first.y, 0.0});
        const auto planes = tf::align(moving, fixed);
        CHECK(planes.converged);
        CHECK(off_by(moving, planes.matrix, right) < 0.02);
        CHECK(planes.uncertainty < 0.02);
        // distances of points alone are held back
        const auto points =
            tf::align(moving, fixed, {.method = tf::align_method::point_to_point, .robust = false});
        CHECK(off_by(moving, points.matrix, right) > 0.05);
        CHECK_FALSE(points.converged);
    }
}

TEST_CASE("align: what does not tell where it belongs is in doubt, with how far it may be off") {
    test::random source(2);
    // hills too low for 300 points and their noise
    const auto hills = [&](std::size_t count, double height) {
        std::vector<point3> points;
        for (std::size_t i = 0; i < count; ++i) {
            const double x = source.in(0, 10), y = source.in(0, 10);
            points.push_back(
                {x, y, height * std::sin(x) * std::cos(0.7 * y) + 0.03 * test::gaussian(source)});
        }
        return points;
    };
    const auto away = test::turn_about({0, 0, 1}, 0.05, {5, 5, 0}, {0.2, 0.1, 0.1});
    const auto fit = [&](std::size_t count, double height) {
        std::vector<point3> moving = hills(count, height);
        for (point3& p : moving) p = away(p);
        return tf::align(moving, {hills(count, height), {}});
    };
    const auto low = fit(300, 0.05), high = fit(6000, 1.0);
    CHECK(low.outcome == tf::align_outcome::doubtful);
    CHECK(high.converged);
    CHECK(high.uncertainty < 0.01);
    CHECK(low.uncertainty > 10.0 * high.uncertainty);
}

TEST_CASE("align: of the same points that are flat, their places hold them") {
    test::random source(3);
    std::vector<point3> home, away;
    for (int i = 0; i < 500; ++i) home.push_back({source.in(0, 10), source.in(0, 10), 0});
    const auto motion = test::turn_about({0, 0, 1}, 0.01, {5, 5, 0}, {0.02, -0.03, 0.1});
    for (const point3& p : home) away.push_back(motion(p));
    const auto found = tf::align(away, home);
    double most = 0.0;
    for (std::size_t i = 0; i < home.size(); ++i)
        most = std::max({most, std::abs(found.points[i].x - home[i].x),
                         std::abs(found.points[i].y - home[i].y)});
    CHECK(most < 1e-9);
    CHECK(found.converged);
}

TEST_CASE("align: a scale of 2 or a half is found, on clouds and on meshes, both ways") {
    test::random source(4);
    const tf::mesh solid = three_sizes();
    const std::vector<point3> home = test::spread_over(source, solid, 5000);
    const std::vector<point3> other = test::spread_over(source, solid, 5000);
    for (const double scale : {0.5, 2.0, 25.4}) {
        CAPTURE(scale);
        auto away = test::turn_about({0, 0.6, 0.8}, 0.05, {1, 1, 1}, {0.1, 0.05, -0.1});
        for (auto& row : away.rows)
            for (double& entry : row) entry *= scale;
        std::vector<point3> there;
        for (const point3& p : home) there.push_back(away(p));
        for (const bool cloud : {false, true}) {
            CAPTURE(cloud);
            const auto found = cloud ? tf::align(there, other, {.scale = true})
                                     : tf::align(there, solid, {.scale = true});
            CHECK(found.converged);
            CHECK(found.scale == doctest::Approx(1.0 / scale).epsilon(cloud ? 2e-3 : 1e-9));
        }
    }
}

TEST_CASE("align: a scale stays within its bounds, and is in doubt at one") {
    test::random source(6);
    const tf::mesh solid = three_sizes();
    auto half = test::turn_about({0, 0.6, 0.8}, 0.05, {1, 1, 1}, {0.1, 0.05, -0.1});
    for (auto& row : half.rows)
        for (double& entry : row) entry *= 0.5;
    std::vector<point3> there;
    for (const point3& p : test::spread_over(source, solid, 1000)) there.push_back(half(p));
    const std::vector<point3> other = test::spread_over(source, solid, 1000);
    constexpr double none = std::numeric_limits<double>::infinity();
    for (const bool cloud : {false, true}) {
        CAPTURE(cloud);
        const auto within = [&](double least, double most, unsigned starts = 1) {
            const tf::align_options how{
                .scale = true, .least_scale = least, .most_scale = most, .starts = starts};
            return cloud ? tf::align(there, other, how) : tf::align(there, solid, how);
        };
        for (const auto& [least, most] : {std::pair{1.5, 3.0}, {1.9, none}, {0.0, 2.1}}) {
            const auto found = within(least, most);
            CHECK(found.converged);
            CHECK(found.scale == doctest::Approx(2.0).epsilon(2e-3));
        }
        for (const unsigned starts : {1U, 2U}) {
            const auto above = within(3.0, 4.0, starts), below = within(0.1, 1.5, starts);
            CHECK(above.scale == doctest::Approx(3.0).epsilon(1e-9));
            CHECK(above.outcome == tf::align_outcome::doubtful);
            CHECK(above.matrix != tf::transform<3>{});
            CHECK(below.scale == doctest::Approx(1.5).epsilon(1e-9));
            CHECK(below.outcome == tf::align_outcome::doubtful);
        }
        const auto known = within(2.0, 2.0);
        CHECK(known.converged);
        CHECK(known.scale == 2.0);
    }
}

TEST_CASE("align: no scale puts all points on one, wherever they start") {
    test::random source(5);
    const tf::mesh solid = three_sizes();
    const std::vector<point3> other = test::spread_over(source, solid, 2000);
    for (int round = 0; round < 12; ++round) {
        CAPTURE(round);
        std::vector<point3> there = test::spread_over(source, solid, 2000);
        const auto away = test::turn_about(test::direction(source), source.in(0, 3), {1, 1, 1},
                                           {source.in(-9, 9), source.in(-9, 9), 0});
        for (point3& p : there) p = away(p);
        const bool cloud = round % 2 == 0;
        const auto method = static_cast<tf::align_method>(source.below(4));
        const auto found = cloud ? tf::align(there, other, {.method = method, .scale = true})
                                 : tf::align(there, solid, {.method = method, .scale = true});
        CHECK(found.scale > 0.4);
        CHECK(found.scale < 2.5);
        auto right = away;
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t c = 0; c < 3; ++c) right.rows[r][c] = away.rows[c][r];
        for (std::size_t r = 0; r < 3; ++r) {
            right.rows[r][3] = 0.0;
            for (std::size_t c = 0; c < 3; ++c)
                right.rows[r][3] -= away.rows[c][r] * away.rows[c][3];
        }
        if (found.converged) CHECK(off_by(there, found.matrix, right) < 0.02);
    }
}

TEST_CASE("align: planes of both clouds are the same on any number of threads") {
    const tf::mesh room = hall();
    test::random source(6);
    const std::vector<point3> fixed = sweep(room, {0, 0, 1.8}, 0.01, source);
    const std::vector<point3> moving = sweep(room, {0.5, 0.3, 1.8}, 0.01, source);
    const auto one = tf::align(moving, fixed, {.scale = true});
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        const auto other = tf::align(moving, fixed, {.scale = true});
        CHECK(other.matrix == one.matrix);
        CHECK(other.uncertainty == one.uncertainty);
    }
}
