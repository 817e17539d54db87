/// \file
/// Solids grown, shrunk, hollowed, and surfaces made thick: certified, at their distance, on the
/// right side, in volumes that are known.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/offset.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/solid_checks.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr double pi = std::numbers::pi;

/// What holds of every surface at a distance.
tf::mesh checked(const tf::offset_result& made) {
    REQUIRE(made.certificate);
    CHECK(test::is_clean_solid(made.mesh));
    CHECK(made.least_distance <= made.distance * 1.0001);
    CHECK(made.greatest_distance >= made.distance * 0.9999);
    CHECK(made.least_distance >= made.distance - 2 * made.resolution);
    CHECK(made.greatest_distance <= made.distance + 2 * made.resolution);
    return made.mesh;
}

/// Points of the faces are within the bounds that were measured.
void check_bounds(const tf::offset_result& made, const tf::mesh& of) {
    std::vector<tf::point3> places = made.mesh.points;
    for (const tf::face& f : made.mesh.faces) {
        tf::point3& middle = places.emplace_back();
        for (const std::uint32_t v : f)
            for (std::size_t k = 0; k < 3; ++k) middle[k] += made.mesh.points[v][k] / 3;
    }
    double least = std::numeric_limits<double>::infinity(), greatest = 0.0;
    for (const auto& near : tf::closest_point(of, places)) {
        least = std::min(least, near->distance);
        greatest = std::max(greatest, near->distance);
    }
    CHECK(least >= made.least_distance * (1 - 1e-12));
    CHECK(greatest <= made.greatest_distance * (1 + 1e-12));
    // Each bound is near to what is there.
    CHECK(greatest >= made.greatest_distance - 0.5 * made.resolution);
}

/// An n x n height map over the unit square.
tf::mesh height_map(std::uint32_t n, double height) {
    tf::mesh mesh;
    const double step = 1.0 / n;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i)
            mesh.points.push_back({i * step, j * step, height * std::sin(6.0 * i * step)});
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i, c = a + n + 1;
            mesh.faces.push_back({a, a + 1, c + 1});
            mesh.faces.push_back({a, c + 1, c});
        }
    return mesh;
}

}  // namespace

TEST_CASE("a cube grows by prisms, quarters of cylinders and a ball, and shrinks to a cube") {
    const tf::mesh cube = test::box(1, 1, 1);
    const double d = 0.2;
    const auto grown = tf::offset(cube, d, {.resolution = 0.04});
    checked(grown);
    check_bounds(grown, cube);
    CHECK(tf::signed_volume(grown.mesh) ==
          doctest::Approx(1 + 6 * d + 3 * pi * d * d + 4 * pi * d * d * d / 3).epsilon(0.005));
    const auto shrunk = tf::offset(cube, -d, {.resolution = 0.04});
    checked(shrunk);
    check_bounds(shrunk, cube);
    CHECK(tf::signed_volume(shrunk.mesh) == doctest::Approx(0.216).epsilon(0.01));
    CHECK(tf::contains(grown.mesh, {1.15, 0.5, 0.5}));
    CHECK(!tf::contains(shrunk.mesh, {0.9, 0.5, 0.5}));
}

TEST_CASE("a finer resolution is nearer to the distance on a ball") {
    const tf::mesh ball = test::ball(4, 1.0);
    double before = 1.0;
    for (const double resolution : {0.1, 0.05, 0.025}) {
        const auto made = tf::offset(ball, 0.25, {.resolution = resolution});
        checked(made);
        const double error = made.greatest_distance - made.least_distance;
        CHECK(error < before);
        before = error;
    }
    CHECK(before < 0.01);
}

TEST_CASE(
    "a solid inside out, one that overlaps itself and a cavity count as what they wind around") {
    tf::mesh out = test::box(1, 1, 1);
    for (tf::face& f : out.faces) std::swap(f[1], f[2]);
    CHECK(tf::signed_volume(checked(tf::offset(out, 0.1))) > 1.0);
    tf::mesh moved = test::box(1, 1, 1);
    for (tf::point3& p : moved.points) p.x += 0.5;
    const std::vector<tf::mesh> two{test::box(1, 1, 1), moved};
    const tf::mesh within = checked(tf::offset(tf::concatenate(two), -0.2, {.resolution = 0.05}));
    CHECK(tf::signed_volume(within) == doctest::Approx(1.1 * 0.6 * 0.6).epsilon(0.02));
    const tf::mesh shell = checked(
        tf::offset(tf::hollow(test::box(1, 1, 1), 0.2).value(), -0.05, {.resolution = 0.02}));
    CHECK(tf::signed_volume(shell) ==
          doctest::Approx(0.729 - (0.216 + 6 * 0.36 * 0.05 + 3 * 0.6 * pi * 0.0025)).epsilon(0.02));
}

TEST_CASE("a hollow cube keeps its surface, and drains lead into it") {
    const tf::mesh cube = test::box(10, 10, 10);
    const auto closed = tf::hollow(cube, 1, {.resolution = 0.25});
    REQUIRE(closed.certificate);
    CHECK(test::is_clean_solid(closed.mesh));
    CHECK(tf::signed_volume(closed.mesh) == doctest::Approx(1000 - 512).epsilon(0.01));
    for (std::size_t v = 0; v < 8; ++v) CHECK(closed.mesh.points[v] == cube.points[v]);
    const auto drained =
        tf::hollow(cube, 1, {.resolution = 0.25, .drains = {{{5, 5, 10}, 2}, {{5, 5, -3}, 1}}});
    REQUIRE(drained.certificate);
    CHECK(test::is_clean_solid(drained.mesh));
    CHECK(tf::count_topology(drained.mesh.points.size(), drained.mesh.faces).components_by_point ==
          1);
    CHECK(tf::signed_volume(drained.mesh) ==
          doctest::Approx(tf::signed_volume(closed.mesh) - pi - pi / 4).epsilon(0.002));
    CHECK(!tf::contains(drained.mesh, {5, 5, 0.5}));
}

TEST_CASE("a drain ends in the cavity, and what none leads into is counted") {
    const tf::mesh slab = test::box(10, 10, 3);
    const tf::offset_options how{.resolution = 0.3};
    const auto drained = tf::hollow(slab, 1, {.resolution = 0.3, .drains = {{{5, 5, 3}, 4}}});
    REQUIRE(drained.certificate);
    CHECK(tf::contains(drained.mesh, {5, 5, 0.5}));  // the wall across is whole
    CHECK(!tf::contains(drained.mesh, {5, 5, 2.5}));
    CHECK(drained.blind_drains.empty());
    CHECK(drained.sealed_cavities == 0);
    CHECK(tf::hollow(slab, 1, how).sealed_cavities == 1);
    const std::array two{slab, test::moved(slab, {20, 0, 0})};
    const auto half =
        tf::hollow(tf::concatenate(two), 1, {.resolution = 0.3, .drains = {{{25, 5, 9}, 1}}});
    REQUIRE(half.certificate);
    CHECK(half.blind_drains.empty());
    CHECK(half.sealed_cavities == 1);
    // A slot narrower than the drain is wide: the wall across is not drilled.
    const tf::mesh slotted =
        tf::difference(test::box(10, 10, 10), test::moved(test::box(12, 12, 1), {-1, -1, 4.5}))
            .value();
    const auto into_slot =
        tf::hollow(slotted, 1, {.resolution = 0.3, .drains = {{{5, 5, 4.6}, 3}}});
    REQUIRE(into_slot.certificate);
    CHECK(into_slot.blind_drains.empty());
    CHECK(!tf::contains(into_slot.mesh, {5, 5, 4}));
    CHECK(tf::contains(into_slot.mesh, {5, 5, 6}));
    CHECK(into_slot.sealed_cavities == 1);
}

TEST_CASE("a drain whose axis passes by the cavity is named") {
    // Near the edge of a wedge of 20 degrees, the edge of the cavity is nearest, at a slant.
    const double high = 20 * std::tan(pi / 18), at = 2.3;
    const tf::mesh wedge{
        {{0, 0, 0}, {20, 0, -high}, {20, 0, high}, {0, 10, 0}, {20, 10, -high}, {20, 10, high}},
        {{0, 1, 2}, {3, 5, 4}, {0, 3, 4}, {0, 4, 1}, {1, 4, 5}, {1, 5, 2}, {2, 5, 3}, {2, 3, 0}}};
    const auto made = tf::hollow(
        wedge, 0.5,
        {.resolution = 0.1, .drains = {{{20, 5, 0}, 1}, {{at, 5, at * high / 20}, 0.1}}});
    REQUIRE(made.certificate);
    CHECK(made.blind_drains == std::vector<std::uint32_t>{1});
}

TEST_CASE("without a resolution, cells are a share of the distance within a budget of faces") {
    const tf::mesh cube = test::box(1, 1, 1);
    for (const double d : {0.05, 0.25, 1.0, 100.0}) {
        const auto made = tf::offset(cube, d);
        checked(made);
        CHECK(made.mesh.faces.size() < 250'000);
        CHECK(made.greatest_distance < 1.02 * d);
        CHECK(made.least_distance > 0.96 * d);
    }
    // As fine as 32-bit coordinates allow there, where that is coarser.
    const tf::offset_options rough{.precision = tf::precision::float32};
    const auto far = tf::offset(test::moved(cube, {100, 0, 0}), 0.3, rough);
    checked(far);
    CHECK(far.resolution == 0.125);
}

TEST_CASE("what is nowhere so thick vanishes, and an open surface bounds no solid") {
    const tf::mesh cube = test::box(1, 1, 1);
    CHECK(tf::offset(cube, -0.6).certificate.status == tf::status::vanished);
    CHECK(tf::hollow(cube, 0.6).certificate.status == tf::status::vanished);
    tf::mesh open = cube;
    open.faces.pop_back();
    for (const double d : {0.1, -0.1}) {
        const tf::certificate known = tf::offset(open, d).certificate;
        CHECK(known.status == tf::status::open_input);
        CHECK(known.open_faces.at(0).operand == tf::operand_element::none);
    }
    CHECK_THROWS_AS((void)tf::hollow(open, 0.1).value(), tf::not_certified_error);
}

TEST_CASE("a plate becomes a slab with a round rim, on either side, both, or more to one") {
    const tf::mesh plate = height_map(4, 0.0);
    const double t = 0.1, r = t / 2;
    const double volume = t + 4 * pi * r * r / 2 + 4 * pi * r * r * r / 3;
    for (const double middle : {0.0, r, -r, 0.4 * r}) {
        const auto made = tf::thicken(plate, t, {.resolution = 0.0125, .shift = middle});
        checked(made);
        CHECK(tf::signed_volume(made.mesh) == doctest::Approx(volume).epsilon(0.01));
        const tf::box3 box = *tf::bounding_box(made.mesh.points);
        CHECK(box.max.z == doctest::Approx(middle + r).epsilon(0.01));
        CHECK(box.min.z == doctest::Approx(middle - r).epsilon(0.01));
    }
}

TEST_CASE("a height map, one face and a closed surface are made thick") {
    const tf::mesh map = height_map(20, 0.2);
    const auto made = tf::thicken(map, 0.05);
    checked(made);
    check_bounds(made, map);
    checked(tf::thicken(tf::mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, 0.2));
    const tf::mesh shell = checked(tf::thicken(test::box(1, 1, 1), 0.1, {.resolution = 0.02}));
    CHECK(tf::count_topology(shell.points.size(), shell.faces).components_by_point == 2);
}

TEST_CASE("float32 is certified in its coordinates, and the same twice") {
    const tf::offset_options options{.resolution = 0.05, .precision = tf::precision::float32};
    const auto made = tf::offset(test::ball(2, 1.0), 0.3, options);
    checked(made);
    for (const tf::point3& p : made.mesh.points)
        CHECK(static_cast<double>(static_cast<float>(p.x)) == p.x);
    CHECK(tf::offset(test::ball(2, 1.0), 0.3, options).mesh == made.mesh);
}

TEST_CASE("what makes no sense is refused, with what would do") {
    const tf::mesh cube = test::box(1, 1, 1);
    const double inf = std::numeric_limits<double>::infinity();
    for (const double d : {0.0, inf, std::nan("")})
        CHECK_THROWS_AS((void)tf::offset(cube, d), std::invalid_argument);
    for (const double r : {0.0, -1.0, 0.06, 1e-13, inf})
        CHECK_THROWS_AS((void)tf::offset(cube, 0.1, {.resolution = r}), std::invalid_argument);
    CHECK_THROWS_AS((void)tf::hollow(cube, -0.1), std::invalid_argument);
    CHECK_THROWS_AS((void)tf::hollow(cube, 0.1, {.drains = {{{0, 0, 0}, 0.0}}}),
                    std::invalid_argument);
    CHECK_THROWS_AS((void)tf::thicken(tf::mesh{}, 0.1), std::invalid_argument);
    CHECK_THROWS_AS((void)tf::thicken(cube, 0.1, {.shift = inf}), std::invalid_argument);
    tf::mesh turned = height_map(1, 0.0);
    std::swap(turned.faces[0][1], turned.faces[0][2]);
    CHECK_THROWS_AS((void)tf::thicken(turned, 0.1, {.shift = 0.05}), std::invalid_argument);
    CHECK(tf::thicken(turned, 0.1).certificate);
    try {
        (void)tf::offset(cube, 0.1, {.resolution = 1e-5});
        CHECK(false);
    } catch (const std::invalid_argument& error) {
        CHECK(std::string(error.what()).find(" or more, for") != std::string::npos);
    }
}

TEST_CASE("it stops when it is told to, whenever that is") {
    const tf::mesh ball = test::ball(2, 1.0);
    int heard = 0;
    (void)tf::hollow(ball, 0.2,
                     {.resolution = 0.1, .progress = [&](double) { return ++heard > 0; }});
    CHECK(heard > 12);
    for (int stop = 0; stop < heard; stop += 3) {
        int calls = 0;
        const auto made = tf::hollow(
            ball, 0.2, {.resolution = 0.1, .progress = [&](double) { return ++calls <= stop; }});
        CHECK(made.certificate.status == tf::status::cancelled);
        CHECK(made.mesh.faces.empty());
        CHECK(calls == stop + 1);
    }
}

TEST_CASE("each verb says its own name") {
    const tf::mesh cube = test::box(1, 1, 1);
    const auto message = [](const auto& call) -> std::string {
        try {
            call();
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return {};
    };
    for (const double r : {1.0, 1e-4, 1e-15}) {
        const tf::offset_options how{.resolution = r};
        CHECK(message([&] { (void)tf::offset(cube, 0.1, how); }).starts_with("treeform::offset: "));
        CHECK(message([&] { (void)tf::hollow(cube, 0.1, how); }).starts_with("treeform::hollow: "));
        CHECK(
            message([&] { (void)tf::thicken(cube, 0.1, how); }).starts_with("treeform::thicken: "));
    }
    CHECK(message([] {
              (void)tf::thicken(tf::mesh{{}, {{0, 1, 2}}}, 1.0);
          }).starts_with("treeform::thicken: "));
}
