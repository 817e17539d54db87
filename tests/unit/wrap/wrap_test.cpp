/// \file
/// Wraps: certified, with the mesh inside, at their distance from it; holes are closed or not by
/// the size.

#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/offset.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solid_checks.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

/// What holds of every wrap.
tf::offset_result wrapped(const tf::mesh& mesh, double size,
                          const tf::offset_options& options = {}) {
    tf::offset_result made = tf::wrap(mesh, size, options);
    CHECK(made.certificate);
    CHECK(test::is_clean_solid(made.mesh));
    CHECK(tf::signed_volume(made.mesh) > 0.0);
    CHECK(tf::mesh_intersections(made.mesh, mesh).pairs.empty());
    for (const tf::face& f : mesh.faces) CHECK(tf::contains(made.mesh, mesh.points[f[0]]));
    const double offset = options.offset.value_or(size / 30);
    for (const tf::point3& p : made.mesh.points)
        CHECK(tf::closest_point(mesh, p)->distance == doctest::Approx(offset).epsilon(0.02));
    CHECK(made.distance == offset);
    return made;
}

std::uint64_t components(const tf::mesh& mesh) {
    return tf::count_topology(mesh.points.size(), mesh.faces).components_by_point;
}

/// Without the two faces of one side.
tf::mesh open_box() {
    tf::mesh mesh = test::box(1, 1, 1);
    mesh.faces.erase(mesh.faces.begin(), mesh.faces.begin() + 2);
    return mesh;
}

}  // namespace

TEST_CASE("a ball is followed the more closely the smaller the size") {
    const tf::mesh ball = test::ball(4, 1.0);
    const double volume = tf::signed_volume(ball);
    double before = std::numeric_limits<double>::infinity();
    for (const double size : {1.0, 0.3, 0.1}) {
        const double now = tf::signed_volume(wrapped(ball, size).mesh);
        CHECK(now > volume);
        CHECK(now < before);
        before = now;
    }
    CHECK(before < 1.03 * volume);
}

TEST_CASE("a hole is closed where the size is wider, and else the wrap goes inside") {
    const tf::mesh box = open_box();
    const double closed = tf::signed_volume(wrapped(box, 1.2).mesh);
    CHECK(closed > 0.9);
    const double shell = tf::signed_volume(wrapped(box, 0.1).mesh);
    CHECK(shell < 0.2);
}

TEST_CASE("faces that cross, lie on each other, are turned or have no area") {
    test::random source(3);
    wrapped(test::random_soup(source, 40, 0.5), 0.1);
    wrapped(test::lattice_soup(source, 60, 20, 4), 0.5);
    wrapped(test::inside_out(test::box(1, 2, 3)), 0.3);
    const tf::mesh box = test::box(1, 1, 1);
    wrapped(test::together(box, test::moved(box, {1, 1, 0})), 0.2);
    wrapped({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, 0.1);
    wrapped({{{0, 0, 0}, {1, 1, 1}}, {{0, 1, 1}}}, 0.1);
    wrapped({{{5, 5, 5}}, {{0, 0, 0}}}, 0.1);
}

TEST_CASE("parts that are further apart than the size stay apart, and cavities are filled") {
    const tf::mesh box = test::box(1, 1, 1);
    const auto boxes = [&](double apart) {
        return test::together(box, test::moved(box, {1 + apart, 0, 0}));
    };
    CHECK(components(wrapped(boxes(2.0), 0.3).mesh) == 2);
    CHECK(components(wrapped(boxes(0.2), 0.3).mesh) == 1);
    const tf::mesh hollow = test::together(
        test::box(3, 3, 3), test::moved(test::inside_out(test::box(1, 1, 1)), {1, 1, 1}));
    const tf::offset_result made = wrapped(hollow, 0.3);
    CHECK(tf::signed_volume(made.mesh) > 27.0);
    CHECK(components(made.mesh) == 1);
}

TEST_CASE("the offset is as asked for, also a wide one") {
    wrapped(test::box(1, 1, 1), 0.2, {.offset = 0.3});
    wrapped(test::box(1, 1, 1), 0.2, {.offset = 0.002});
}

TEST_CASE("coordinates are of the precision asked for, far from the origin, too") {
    const tf::mesh ball = test::moved(test::ball(3, 1.0), {100, 200, 300});
    const tf::offset_result made = wrapped(ball, 0.2, {.precision = tf::precision::float32});
    for (const tf::point3& p : made.mesh.points)
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(p[k] == static_cast<double>(static_cast<float>(p[k])));
}

TEST_CASE("the same on any number of threads, and of any length unit") {
    const tf::mesh ball = test::ball(3, 1.0);
    const tf::mesh one = tf::wrap(ball, 0.2).mesh;
    {
        const tf::thread_scope single(1);
        CHECK(tf::wrap(ball, 0.2).mesh == one);
    }
    for (const double by : {0x1p100, 0x1p-100})
        CHECK(tf::wrap(test::scaled(ball, by), 0.2 * by).mesh == test::scaled(one, by));
}

TEST_CASE("what cannot be wrapped") {
    const tf::mesh box = test::box(1, 1, 1);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {0.0, -1.0, infinity, std::nan("")}) {
        CHECK_THROWS_AS((void)tf::wrap(box, bad), std::invalid_argument);
        CHECK_THROWS_AS((void)tf::wrap(box, 1.0, {.offset = bad}), std::invalid_argument);
    }
    CHECK_THROWS_WITH((void)tf::wrap(tf::mesh{}, 1.0), "treeform::wrap: the mesh has no faces");
    CHECK_THROWS_WITH((void)tf::wrap(box, 1e-5, {.precision = tf::precision::float32}),
                      doctest::Contains("is too small: coordinates are"));
    CHECK_THROWS_WITH((void)tf::wrap(test::scaled(box, 0x1p200), 0x1p190),
                      doctest::Contains("2^150"));
    CHECK_THROWS_WITH((void)tf::wrap(box, 1e-6),
                      "treeform::wrap: the size 1e-06 is too small: the wrap would have more than "
                      "10^9 faces");
    tf::mesh broken = box;
    broken.points[3].x = infinity;
    CHECK_THROWS_AS((void)tf::wrap(broken, 1.0), std::invalid_argument);
}

TEST_CASE("progress grows, and stops the work") {
    double last = 0.0;
    const auto made = tf::wrap(test::ball(3, 1.0), 0.1, {.progress = [&](double done) {
                                   CHECK(done >= last);
                                   last = done;
                                   return true;
                               }});
    CHECK(made.certificate);
    CHECK(last > 0.9);
    const auto stopped =
        tf::wrap(test::ball(3, 1.0), 0.1, {.progress = [](double done) { return done < 0.5; }});
    CHECK(stopped.certificate.status == tf::status::cancelled);
    CHECK(stopped.mesh.faces.empty());
    CHECK_THROWS_AS((void)stopped.value(), tf::not_certified_error);
}
