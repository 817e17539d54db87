#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/slide.hpp>
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
#include <vector>

namespace {

using std::numbers::pi;
using tf::feature_kind;

double dot(const tf::point3& a, const tf::point3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double length(const tf::point3& a) { return std::sqrt(dot(a, a)); }
tf::point3 minus(const tf::point3& a, const tf::point3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

/// A solid of revolution about z: its section goes around, outside on the right of each step.
tf::mesh turned_part(const std::vector<std::array<double, 2>>& section, std::uint32_t corners) {
    tf::mesh mesh;
    const auto n = static_cast<std::uint32_t>(section.size());
    for (std::uint32_t i = 0; i < corners; ++i) {
        const double c = std::cos(2 * pi * i / corners), s = std::sin(2 * pi * i / corners);
        for (const auto& [r, z] : section) mesh.points.push_back({r * c, r * s, z});
        const std::uint32_t j = (i + 1) % corners;
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t l = (k + 1) % n;
            mesh.faces.push_back({n * i + k, n * j + k, n * j + l});
            mesh.faces.push_back({n * i + k, n * j + l, n * i + l});
        }
    }
    return mesh;
}

tf::mesh tube(double outer, double inner, double height, std::uint32_t corners) {
    return turned_part({{inner, 0}, {outer, 0}, {outer, height}, {inner, height}}, corners);
}

tf::transform<3> random_move(test::random& source) {
    double q[4], size = 0.0;
    for (double& x : q) {
        x = source.in(-1, 1);
        size += x * x;
    }
    for (double& x : q) x /= std::sqrt(size);
    const auto [w, x, y, z] = q;
    tf::transform<3> r;
    r.rows = {
        {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), source.in(-9, 9)},
         {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), source.in(-9, 9)},
         {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), source.in(-9, 9)}}};
    return r;
}

tf::mesh moved_by(tf::mesh mesh, const tf::transform<3>& by) {
    for (tf::point3& p : mesh.points) p = by(p);
    return mesh;
}

/// That it penetrates nothing, and that the matrix says how it went there.
void check_features(const tf::mesh& moving, const tf::mesh& fixed, const tf::placement& found) {
    REQUIRE(found);
    const tf::mesh there{found.points, moving.faces};
    CHECK(tf::relation(there, fixed).relation != tf::mesh_relation::penetrating);
    for (std::size_t i = 0; i < moving.points.size(); ++i)
        CHECK(length(minus(found.matrix(moving.points[i]), found.points[i])) < 1e-11);
}

}  // namespace

TEST_CASE("features: a box has six planes and no axis, also with its edges cut off") {
    const tf::mesh box = test::moved(test::box(3, 2, 1), {5, 5, 5});
    const auto planes = tf::find_features(box, feature_kind::plane);
    REQUIRE(planes.size() == 6);
    CHECK(planes[0].area == doctest::Approx(6));
    CHECK(planes[5].area == doctest::Approx(2));
    for (const tf::mesh_feature& plane : planes) {
        CHECK(plane.faces.size() == 2);
        CHECK(plane.deviation < 1e-14);
        CHECK(dot(plane.direction, minus(plane.origin, {6.5, 6, 5.5})) > 0.4);
        CHECK(std::max({std::abs(plane.direction.x), std::abs(plane.direction.y),
                        std::abs(plane.direction.z)}) == 1.0);
    }
    CHECK(tf::find_features(box, feature_kind::axis).empty());
    // A bar of eight sides, four of them narrow, is no cylinder.
    tf::mesh bar;
    const std::array<std::array<double, 2>, 8> outline{
        {{0, 1}, {1, 0}, {9, 0}, {10, 1}, {10, 9}, {9, 10}, {1, 10}, {0, 9}}};
    for (const double z : {0.0, 30.0})
        for (const auto& [x, y] : outline) bar.points.push_back({x, y, z});
    for (std::uint32_t i = 0; i < 8; ++i) {
        const std::uint32_t j = (i + 1) % 8;
        bar.faces.insert(bar.faces.end(), {{i, j, j + 8}, {i, j + 8, i + 8}});
        if (i > 1) bar.faces.insert(bar.faces.end(), {{0, i, i - 1}, {8, i + 7, i + 8}});
    }
    CHECK(tf::find_features(bar, feature_kind::plane).size() == 10);
    CHECK(tf::find_features(bar, feature_kind::axis).empty());
}

TEST_CASE(
    "features: a tube anywhere has the axes of its two walls, and four planes do not matter") {
    test::random source(1);
    for (int round = 0; round < 10; ++round) {
        CAPTURE(round);
        const tf::transform<3> move = random_move(source);
        const tf::mesh part = moved_by(tube(5, 3, 7, 24 + 4 * static_cast<unsigned>(round)), move);
        const auto axes = tf::find_features(part, feature_kind::axis);
        REQUIRE(axes.size() == 2);
        const tf::point3 z{move.rows[0][2], move.rows[1][2], move.rows[2][2]};
        for (const tf::mesh_feature& axis : axes) {
            CHECK(std::abs(std::abs(dot(axis.direction, z)) - 1.0) < 1e-12);
            CHECK(length(minus(axis.origin, move(tf::point3{0, 0, 3.5}))) < 1e-10);
            CHECK(axis.deviation < 1e-10);
        }
        CHECK(axes[0].radius == doctest::Approx(5).epsilon(1e-11));
        CHECK_FALSE(axes[0].hollow);
        CHECK(axes[1].radius == doctest::Approx(3).epsilon(1e-11));
        CHECK(axes[1].hollow);
        const auto planes = tf::find_features(part, feature_kind::plane);
        REQUIRE(planes.size() > 2);
        CHECK(std::abs(std::abs(dot(planes[0].direction, z)) - 1.0) < 1e-12);
        const auto at =
            tf::feature_at(part, feature_kind::axis,
                           tf::closest_point(part, move(tf::point3{3, 0.1, 3})).value().face);
        REQUIRE(at);
        CHECK(at->faces == axes[1].faces);
        CHECK(tf::feature_at(part, feature_kind::axis, axes[0].faces[3])->faces == axes[0].faces);
        const auto fitted = tf::fit_feature(part, feature_kind::axis, axes[1].faces);
        CHECK(fitted->radius == doctest::Approx(3).epsilon(1e-11));
    }
}

TEST_CASE("features: least squares takes noise out") {
    test::random source(2);
    tf::mesh part = tube(5, 3, 7, 64);
    for (tf::point3& p : part.points)
        for (std::size_t k = 0; k < 3; ++k) p[k] += source.in(-1e-4, 1e-4);
    const auto axes = tf::find_features(part, feature_kind::axis, {.tolerance = 3e-4});
    REQUIRE(axes.size() == 2);
    CHECK(axes[0].radius == doctest::Approx(5).epsilon(1e-5));
    CHECK(std::abs(axes[0].direction.z) > 1.0 - 1e-8);
    CHECK(axes[0].deviation > 1e-5);
}

TEST_CASE("mate features: a block comes to lie flat on another, center above center") {
    test::random source(3);
    for (int round = 0; round < 12; ++round) {
        CAPTURE(round);
        const tf::mesh block = moved_by(test::box(2, 1, 1), random_move(source));
        const tf::mesh base = moved_by(test::box(9, 9, 4), random_move(source));
        const auto of_block = tf::find_features(block, feature_kind::plane)[0];
        const auto of_base = tf::find_features(base, feature_kind::plane)[0];
        const tf::placement_options options{.clearance = round % 2 == 0 ? 0.0 : 0.5};
        const auto found = tf::mate_features(block, base, of_block, of_base, options);
        check_features(block, base, found);
        CHECK(found.offset == doctest::Approx(options.clearance).epsilon(1e-12));
        CHECK(found.outcome == tf::placement_outcome::contact);
        const tf::mesh there{found.points, block.faces};
        CHECK(tf::distance(there, base) >= options.clearance);
        CHECK(tf::distance(there, base) <= options.clearance + 1e-12);
        const tf::point3 center = found.matrix(of_block.origin);
        const tf::point3 from = minus(center, of_base.origin);
        CHECK(std::abs(length(from) - options.clearance) < 1e-12);
        // All of the face is on the plane.
        for (const std::uint32_t f : of_block.faces)
            for (const std::uint32_t i : block.faces[f])
                CHECK(std::abs(dot(minus(there.points[i], of_base.origin), of_base.direction) -
                               options.clearance) < 1e-12);
    }
    const tf::mesh block = test::box(1, 1, 1), base = test::moved(block, {5, 5, 5});
    const auto up = tf::find_features(block, feature_kind::plane);
    const auto found = tf::mate_features(block, base, up[0], up[0], {.flip = true});
    CHECK(found.angle == 0.0);
}

TEST_CASE("mate features: a bolt goes into its hole, coaxial, until its head is on the plate") {
    test::random source(4);
    for (int round = 0; round < 8; ++round) {
        CAPTURE(round);
        const tf::transform<3> to = random_move(source);
        const tf::mesh plate = moved_by(tube(20, 5.05, 6, 96), to);
        const tf::mesh bolt =
            moved_by(turned_part({{1, 0}, {5, 0}, {5, 15}, {8, 15}, {8, 18}, {1, 18}}, 48),
                     random_move(source));
        const auto in_bolt = tf::find_features(bolt, feature_kind::axis);
        const auto in_plate = tf::find_features(plate, feature_kind::axis);
        REQUIRE(in_bolt.size() == 3);
        const auto& shank = *std::find_if(in_bolt.begin(), in_bolt.end(), [](const auto& f) {
            return std::abs(f.radius - 5) < 1e-6;
        });
        const auto& hole =
            *std::find_if(in_plate.begin(), in_plate.end(), [](const auto& f) { return f.hollow; });
        for (const bool flip : {false, true}) {
            const auto found = tf::mate_features(bolt, plate, shank, hole, {.flip = flip});
            check_features(bolt, plate, found);
            CHECK(found.outcome == tf::placement_outcome::contact);
            const tf::point3 center = minus(found.matrix(shank.origin), hole.origin);
            const double along = dot(center, hole.direction);
            CHECK(std::abs(along) == doctest::Approx(std::abs(found.offset)));
            CHECK(length(minus(center, {along * hole.direction.x, along * hole.direction.y,
                                        along * hole.direction.z})) < 1e-10);
            const tf::mesh there{found.points, bolt.faces};
            CHECK(tf::distance(there, plate) < 1e-10);
            // Head first it stays outside; else the shank is through.
            const double deep = std::abs(found.offset);
            CHECK((std::abs(deep - 4.5) < 1e-9 || deep > 10.0));
        }
    }
}

TEST_CASE("mate features: a shaft that goes through its bore stays in the middle of it") {
    const tf::mesh bore = tube(20, 10.1, 6, 64);
    const tf::mesh shaft = test::moved(tube(10, 4, 30, 64), {50, 3, 2});
    const auto in_bore = tf::find_features(bore, feature_kind::axis)[1];
    const auto on_shaft = tf::find_features(shaft, feature_kind::axis)[0];
    const auto found = tf::mate_features(shaft, bore, on_shaft, in_bore);
    check_features(shaft, bore, found);
    CHECK(found.outcome == tf::placement_outcome::unchanged);
    CHECK(std::abs(found.offset) < 1e-12);
    CHECK(found.relation == tf::mesh_relation::disjoint);
    // One that is too thick stops outside.
    const tf::mesh thick = test::moved(tube(10.2, 4, 30, 64), {50, 3, 2});
    const auto stopped =
        tf::mate_features(thick, bore, tf::find_features(thick, feature_kind::axis)[0], in_bore);
    check_features(thick, bore, stopped);
    CHECK(std::abs(stopped.offset) == doctest::Approx(18));
}

TEST_CASE("features: what cannot be meant is refused, and nothing is found in nothing") {
    const tf::mesh box = test::box(1, 1, 1);
    CHECK(tf::find_features(tf::mesh{}, feature_kind::plane).empty());
    CHECK_FALSE(tf::fit_feature(box, feature_kind::axis, std::array{0U, 1U}));
    CHECK_FALSE(tf::fit_feature(box, feature_kind::plane, {}));
    CHECK_THROWS_AS(static_cast<void>(tf::feature_at(box, feature_kind::plane, 12U)),
                    std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(tf::find_features(box, feature_kind::plane, {.arc = -1})),
                    std::invalid_argument);
    std::vector<double> told;
    const auto record = [&](double done) { return told.push_back(done), true; };
    CHECK(tf::find_features(box, feature_kind::plane, {.progress = record}).size() == 6);
    CHECK(told == std::vector{0.0});
    CHECK(tf::find_features(box, feature_kind::plane, {.progress = [](double) { return false; }})
              .empty());
    tf::mesh broken = box;
    broken.points[2].y = std::numeric_limits<double>::infinity();
    CHECK_THROWS_AS(static_cast<void>(tf::find_features(broken, feature_kind::plane)),
                    std::invalid_argument);
    const auto plane = tf::find_features(box, feature_kind::plane)[0];
    const auto axis = tf::find_features(tube(2, 1, 1, 32), feature_kind::axis)[0];
    CHECK_THROWS_AS(static_cast<void>(tf::mate_features(box, box, plane, axis)),
                    std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(tf::mate_features(box, box, plane, {})),
                    std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(tf::mate_features(box, box, plane, plane, {.clearance = -1})),
                    std::invalid_argument);
}
