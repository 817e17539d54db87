/// \file
/// Angles and solid angles against the standard library and against what closes.

#include <libmesh/base/point_math.hpp>
#include <libmesh/geometry/solid_angle.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>

#include <cmath>

namespace {

using tf::detail::geometry::angle_of;
using tf::detail::geometry::solid_angle;

constexpr double pi = 3.141592653589793;

double angle_around(const tf::mesh& mesh, const tf::point3& q) {
    double sum = 0.0;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const auto [a, b, c] = tf::detail::base::triangle_of(mesh, f);
        using tf::detail::base::minus;
        sum += solid_angle(minus(a, q), minus(b, q), minus(c, q));
    }
    return sum;
}

}  // namespace

TEST_CASE("solid angles: an angle differs from atan2 by less than is said") {
    CHECK(angle_of(0.0, 0.0) == 0.0);
    CHECK(angle_of(0.0, 1.0) == 0.0);
    CHECK(angle_of(0.0, -1.0) == doctest::Approx(pi));
    CHECK(angle_of(-1.0, 0.0) == doctest::Approx(-pi / 2.0));
    double largest = 0.0;
    for (int i = 0; i < 40000; ++i) {
        const double t = i * pi / 20000.0 - pi + 1e-5;
        const double y = 3.0 * std::sin(t), x = 3.0 * std::cos(t);
        largest = std::max(largest, std::abs(angle_of(y, x) - std::atan2(y, x)));
    }
    CHECK(largest < 2e-11);
    CHECK(largest > 0.0);
}

TEST_CASE("solid angles: an octant, and its back") {
    CHECK(solid_angle({1, 0, 0}, {0, 1, 0}, {0, 0, 1}) == doctest::Approx(pi / 2.0));
    CHECK(solid_angle({1, 0, 0}, {0, 0, 1}, {0, 1, 0}) == doctest::Approx(-pi / 2.0));
}

TEST_CASE("solid angles: of a closed surface they add up to all around, or to nothing") {
    const tf::mesh ball = test::ball(2, 1.0);
    test::random source(11);
    for (int i = 0; i < 100; ++i) {
        const tf::point3 in{source.in(-0.4, 0.4), source.in(-0.4, 0.4), source.in(-0.4, 0.4)};
        CHECK(angle_around(ball, in) == doctest::Approx(4.0 * pi).epsilon(1e-8));
        CHECK(std::abs(angle_around(ball, {in.x + 3.0, in.y, in.z})) < 1e-7);
    }
}
