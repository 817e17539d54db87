#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace {

using ids = std::vector<std::uint32_t>;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

bool degenerate(const tf::point3& a, const tf::point3& b, const tf::point3& c) {
    const tf::mesh mesh{{a, b, c}, {{0, 1, 2}}};
    return !tf::find_invalid_faces(mesh).degenerate_faces.empty();
}

}  // namespace

TEST_CASE("validate: a clean mesh and an empty one have no defects") {
    CHECK(tf::find_invalid_faces(tf::mesh{}) == tf::invalid_faces{});
    CHECK(tf::find_invalid_faces(test::grid(10)) == tf::invalid_faces{});
}

TEST_CASE("validate: a face is in one list, the worst") {
    const tf::mesh mesh{
        {{0, 0, 0},
         {1, 0, 0},
         {0, 1, 0},
         {not_a_number, 0, 0},
         {0, -infinity, 0},
         {2, 0, 0},
         {0, 0, not_a_number}},
        {{0, 1, 2}, {0, 1, 3}, {4, 4, 4}, {0, 1, 5}, {0, 0, 2}, {3, 7, 0}, {0, 1, 4000000000}}};
    const tf::invalid_faces found = tf::find_invalid_faces(mesh);
    CHECK(found.nonfinite_points == ids{3, 4, 6});
    CHECK(found.nonfinite_faces == ids{1, 2});
    CHECK(found.degenerate_faces == ids{3, 4});
    CHECK(found.out_of_range_faces == ids{5, 6});
}

TEST_CASE("validate: the first number past the last point is out of range, the last is not") {
    tf::mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    CHECK(tf::find_invalid_faces(mesh).out_of_range_faces.empty());
    mesh.faces[0][1] = 3;
    CHECK(tf::find_invalid_faces(mesh).out_of_range_faces == ids{0});
}

TEST_CASE("validate: collinear is exact, at any size") {
    const double next = std::nextafter(3.0, 4.0);
    for (const double s : {1.0, 0x1p-1000, 0x1p+1000}) {
        CAPTURE(s);
        CHECK(degenerate({1 * s, 1 * s, 1 * s}, {2 * s, 2 * s, 2 * s}, {3 * s, 3 * s, 3 * s}));
        CHECK_FALSE(
            degenerate({1 * s, 1 * s, 1 * s}, {2 * s, 2 * s, 2 * s}, {3 * s, 3 * s, next * s}));
        CHECK(degenerate({0, 0, s}, {0, 0, s}, {s, s, s}));
    }
    CHECK(degenerate({0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.4, 0.4, 0.4}));
    CHECK_FALSE(degenerate({0.1, 0.1, 0}, {0.2, 0.2, 0}, {0.3, std::nextafter(0.3, 1), 0}));
    constexpr double least = std::numeric_limits<double>::denorm_min();
    CHECK_FALSE(degenerate({0, 0, 0}, {least, 0, 0}, {0, 0, least}));
    CHECK(degenerate({0, 0, 0}, {1e300, 0, 0}, {-1e300, 0, 0}));
    CHECK_FALSE(degenerate({0, 0, 0}, {1e300, 0, 0}, {-1e300, 0, least}));
    CHECK(degenerate({-0.0, 0, 0}, {0.0, 0, 0}, {0, 1, 0}));
}

TEST_CASE("validate: on a lattice as whole numbers say, on any number of threads") {
    test::random source(3);
    const tf::mesh soup = test::lattice_soup(source, 200000, 3000, 6);
    ids expected;
    for (std::uint32_t i = 0; i < soup.faces.size(); ++i) {
        const auto& [a, b, c] = soup.faces[i];
        const tf::point3 &p = soup.points[a], &q = soup.points[b], &r = soup.points[c];
        const auto minor = [&](std::size_t x, std::size_t y) {
            return (q[x] - p[x]) * (r[y] - p[y]) - (q[y] - p[y]) * (r[x] - p[x]);
        };
        if (minor(0, 1) == 0 && minor(1, 2) == 0 && minor(2, 0) == 0) expected.push_back(i);
    }
    REQUIRE(expected.size() > 1000);
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        CHECK((tf::find_invalid_faces(soup).degenerate_faces == expected));
    }
}
