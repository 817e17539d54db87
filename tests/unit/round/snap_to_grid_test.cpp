#include <libmesh/round/snap_to_grid.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

using tf::detail::round::on_grid;
using tf::detail::round::snap_to_grid;

TEST_CASE("on a grid: to the nearest multiple, from half-way to the even one, and never to -0") {
    CHECK(on_grid({0.24, 0.26, -0.26}, 0.5) == tf::point3{0.0, 0.5, -0.5});
    CHECK(on_grid({0.25, 0.75, -0.25}, 0.5) == tf::point3{0.0, 1.0, 0.0});
    CHECK(!std::signbit(on_grid({-0.25, 0.0, 0.0}, 0.5).x));
    CHECK(on_grid({0x1p-1074, 0x1p52, 0.0}, 1.0) == tf::point3{0.0, 0x1p52, 0.0});
}

TEST_CASE("on a grid: corners of offending faces move, and others only to where such a one is") {
    tf::mesh mesh;
    mesh.points = {{0.1, 0, 0}, {3.1, 0, 0}, {0, 3.1, 0}, {0.2, 0, 0}, {6.1, 0, 0}, {6, 6.1, 1}};
    mesh.faces = {{0, 1, 2}, {3, 4, 5}};
    const auto snapped = snap_to_grid(mesh, std::vector<std::uint8_t>{1, 0}, {.step = 1.0});
    CHECK(snapped.surface.points ==
          std::vector<tf::point3>{
              {0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 0}, {6.1, 0, 0}, {6, 6.1, 1}});
    CHECK(snapped.surface.faces == std::vector<tf::face>{{0, 1, 2}, {0, 4, 5}});
    CHECK(snapped.face_of == std::vector<std::uint32_t>{0, 1});
    CHECK(snapped.moved == 0.2);
}

TEST_CASE("on a grid: of a solid, what gets no thickness goes; of operands, it stays") {
    const tf::mesh plate = test::box(4.0, 4.0, 0.25);
    const std::vector<std::uint8_t> all(plate.faces.size(), 1);
    CHECK(snap_to_grid(plate, all, {.step = 1.0}).surface.faces.empty());
    CHECK(snap_to_grid(plate, all, {.step = 1.0, .solid = false}).surface.faces.size() == 2);
    CHECK(snap_to_grid(plate, all, {.step = 1.0, .of_operands = true}).surface.faces.size() == 4);
    const std::vector<std::uint8_t> none(plate.faces.size(), 0);
    CHECK(snap_to_grid(plate, none, {.step = 1.0}).surface == plate);
}

TEST_CASE("on a grid: what is snapped once stays, and no two corners are equal") {
    test::random source(1);
    for (int round = 0; round < 20; ++round) {
        const tf::mesh mesh = test::random_soup(source, 300, 0.2);
        const std::vector<std::uint8_t> all(mesh.faces.size(), 1);
        const auto once = snap_to_grid(mesh, all, {.step = 0x1p-5, .solid = false});
        CHECK(once.moved <= 0x1p-6);
        for (const tf::face& f : once.surface.faces)
            for (std::size_t k = 0; k < 3; ++k)
                CHECK(once.surface.points[f[k]] != once.surface.points[f[(k + 1) % 3]]);
        const auto twice =
            snap_to_grid(once.surface, std::vector<std::uint8_t>(once.surface.faces.size(), 1),
                         {.step = 0x1p-5, .solid = false});
        CHECK(twice.surface == once.surface);
        CHECK(twice.moved == 0.0);
    }
}
