#include <libmesh/base/double_double.hpp>
#include <libmesh/base/point_math.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace {

using test::box;
using test::inside_out;
using test::moved;
using test::together;

/// On a lattice of 2^-12, below 2^4, so that all sums below fit into 64 bits.
double whole_volume(const tf::mesh& mesh) {
    const auto whole = [&](std::uint32_t p, std::size_t k) {
        return static_cast<std::int64_t>(mesh.points[p][k] * 0x1p12);
    };
    std::int64_t sum = 0;
    for (const auto& [a, b, c] : mesh.faces)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
            sum += whole(a, k) * (whole(b, i) * whole(c, j) - whole(b, j) * whole(c, i));
        }
    return static_cast<double>(sum) / 6.0 * 0x1p-36;
}

}  // namespace

TEST_CASE("volume: that of boxes, of cavities, of what is inside out") {
    CHECK(tf::signed_volume(tf::mesh{}) == 0.0);
    CHECK(tf::signed_volume(box(1, 2, 3)) == 6.0);
    CHECK(tf::signed_volume(inside_out(box(1, 2, 3))) == -6.0);
    CHECK(tf::signed_volume(together(box(4, 4, 4), moved(inside_out(box(1, 1, 1)), {1, 1, 1}))) ==
          63.0);
    CHECK(tf::signed_volume(together(box(1, 1, 1), box(1, 1, 1))) == 2.0);
}

TEST_CASE("volume: nothing is lost far from the origin") {
    for (const double far : {0x1p20, 0x1p30, -0x1p33})
        CHECK(tf::signed_volume(moved(box(1, 2, 3), {far, far, -far})) == 6.0);
}

TEST_CASE("volume: the sum in whole numbers, whatever the order of points and faces") {
    test::random source(1);
    for (int round = 0; round < 20; ++round) {
        tf::mesh mesh = test::random_soup(source, 300, 8.0);
        for (tf::point3& p : mesh.points)
            for (std::size_t k = 0; k < 3; ++k) p[k] = std::floor(p[k] * 0x1p12) * 0x1p-12;
        const double volume = tf::signed_volume(mesh);
        CHECK(std::abs(volume - whole_volume(mesh)) <= 0x1p-52 * std::abs(volume));
        CHECK(tf::signed_volume(test::shuffled(source, mesh).mesh) ==
              doctest::Approx(volume).epsilon(1e-15));
    }
}

TEST_CASE("volume: the same bits on any number of threads") {
    const tf::mesh mesh = test::ball(6, 1.7);
    const double volume = tf::signed_volume(mesh);
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        CHECK(tf::signed_volume(mesh) == volume);
    }
}

TEST_CASE("volume: as of one face after the other, in twice the precision") {
    test::random source(12);
    for (std::size_t faces = 1; faces < 40; ++faces) {
        tf::mesh soup = test::random_soup(source, faces, 1.0);
        for (tf::point3& p : soup.points) p = {1e3 + p.x, 1e-3 * p.y - 7.0, 1e5 * p.z};
        tf::detail::base::double_double sum;
        for (const tf::face& f : soup.faces) {
            const auto [a, b, c] = tf::detail::base::triangle_of(soup.points, f);
            sum = sum + tf::detail::base::determinant(a, b, c);
        }
        CHECK(tf::signed_volume(soup) == sum.high / 6.0);
    }
}

TEST_CASE("surface_area: the sum of the faces, of corners that are there") {
    CHECK(tf::surface_area(tf::mesh{}) == 0.0);
    CHECK(tf::surface_area(box(1, 2, 3)) == 22.0);
    CHECK(tf::surface_area(inside_out(box(1, 2, 3))) == 22.0);
    tf::mesh wrong = box(1, 1, 1);
    wrong.faces[3][1] = 8;
    CHECK_THROWS_AS((void)tf::surface_area(wrong), std::invalid_argument);
}
