#include <libmesh/round/displacement.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/soups.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

using tf::detail::round::displacement;

namespace {

constexpr std::uint32_t is_new = 1000;

const tf::mesh square{.points = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}},
                      .faces = {{0, 1, 2}, {0, 2, 3}}};

}  // namespace

TEST_CASE("displacement: of a point that was there, in the coordinate that moved furthest") {
    std::vector<tf::point3> now = square.points;
    const std::vector<std::uint32_t> same{0, 1, 2, 3};
    CHECK(displacement(now, same, square) == 0.0);
    now[2] = {2.25, 1.5, 0.125};
    CHECK(displacement(now, same, square) == 0.5);
}

TEST_CASE("displacement: of a new point, from the nearest place of any face") {
    const std::vector<tf::point3> now{{0.5, 0.25, 0.125}, {2.5, 1, 0}};
    const double moved = displacement(now, std::vector{is_new, is_new}, square);
    CHECK(moved >= 0.5);
    CHECK(moved <= std::nextafter(0.5, 1.0) + 0x1p-50);
    // Where it is makes no difference to a point that was there.
    CHECK(displacement(now, std::vector<std::uint32_t>{is_new, 0}, square) == doctest::Approx(2.5));
}

TEST_CASE("displacement: numbers may be as large and as small as they are") {
    for (const double size : {1e-150, 1e150}) {
        tf::mesh scaled = square;
        for (tf::point3& p : scaled.points) p = {p.x * size, p.y * size, p.z * size};
        const std::vector<tf::point3> now{{size, size, size / 4}};
        CHECK(displacement(now, std::vector{is_new}, scaled) / size == doctest::Approx(0.25));
    }
}
