/// \file
/// Generalized winding numbers over the tree against the sum of all faces.

#include <libmesh/base/point_math.hpp>
#include <libmesh/boolean/winding_sum.hpp>
#include <libmesh/geometry/solid_angle.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>

#include <cmath>
#include <vector>

namespace {

using tf::detail::base::minus;
using tf::detail::boolean::winding_sum;

double sum_of_all(const tf::mesh& mesh, const std::vector<double>& times, const tf::point3& q) {
    double sum = 0.0;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const auto [a, b, c] = tf::detail::base::triangle_of(mesh, f);
        sum += times[f] * tf::detail::geometry::solid_angle(minus(a, q), minus(b, q), minus(c, q));
    }
    return sum / (4.0 * 3.141592653589793);
}

}  // namespace

TEST_CASE("winding sum: near the sum of all faces, of whatever is open or turned") {
    tf::mesh ball = test::ball(4, 0.9);
    test::random source(3);
    std::vector<double> times;
    for (std::size_t f = 0; f < ball.faces.size(); ++f)
        times.push_back(f % 7 == 0 ? 0.0 : f % 11 == 0 ? -1.0 : 1.0);
    const winding_sum sum(ball, times);
    for (int i = 0; i < 200; ++i) {
        const tf::point3 q{source.in(-2, 2), source.in(-2, 2), source.in(-2, 2)};
        CHECK(std::abs(sum.around(q) - sum_of_all(ball, times, q)) < 0.05);
    }
}

TEST_CASE("winding sum: a face that is left out, a face that is not there, no face") {
    const tf::mesh box = test::box(1, 1, 1);
    std::vector<double> times(box.faces.size(), 1.0);
    const tf::point3 middle{0.5, 0.5, 0.5};
    CHECK(winding_sum(box, times).around(middle) == doctest::Approx(1.0));
    CHECK(winding_sum(box, times).around(middle, 3) == doctest::Approx(11.0 / 12.0));
    times[3] = 0.0;
    CHECK(winding_sum(box, times).around(middle) == doctest::Approx(11.0 / 12.0));
    CHECK(winding_sum(box, std::vector<double>(12, 0.0)).around(middle) == 0.0);
}
