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
    tf::mesh now = square;
    const std::vector<std::uint32_t> same{0, 1, 2, 3};
    CHECK(displacement(now, same, square).moved == 0.0);
    now.points[2] = {2.25, 1.5, 0.125};
    CHECK(displacement(now, same, square).moved == 0.5);
    CHECK(displacement(now, same, square).gone == 0.0);
}

TEST_CASE("displacement: a point that is gone, from the nearest place on what is left") {
    tf::mesh now = square;
    now.points.pop_back();
    now.faces.pop_back();
    const auto moves = displacement(now, std::vector<std::uint32_t>{0, 1, 2}, square);
    CHECK(moves.moved == 0.0);
    CHECK(moves.gone == doctest::Approx(1.0));  // from (0, 2, 0) to (1, 1, 0)
    tf::mesh before = square;
    before.faces.pop_back();  // no face had it
    CHECK(displacement(now, std::vector<std::uint32_t>{0, 1, 2}, before).gone == 0.0);
}

TEST_CASE("displacement: of a new point, from the nearest place of any face") {
    const tf::mesh now{.points = {{0.5, 0.25, 0.125}, {2.5, 1, 0}}, .faces = {}};
    const double moved = displacement(now, std::vector{is_new, is_new}, square).moved;
    CHECK(moved >= 0.5);
    CHECK(moved <= std::nextafter(0.5, 1.0) + 0x1p-50);
    // Where it is makes no difference to a point that was there.
    CHECK(displacement(now, std::vector<std::uint32_t>{is_new, 0}, square).moved ==
          doctest::Approx(2.5));
}

TEST_CASE("displacement: numbers may be as large and as small as they are") {
    for (const double size : {1e-150, 1e150}) {
        tf::mesh scaled = square;
        for (tf::point3& p : scaled.points) p = {p.x * size, p.y * size, p.z * size};
        const tf::mesh now{.points = {{size, size, size / 4}}, .faces = {}};
        CHECK(displacement(now, std::vector{is_new}, scaled).moved / size == doctest::Approx(0.25));
    }
}
