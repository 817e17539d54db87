/// \file
/// Parts of meshes, meshes one after the other, meshes moved.

#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace {

tf::mesh cavity(double size, const tf::point3& at) {
    tf::mesh mesh = test::moved(test::box(size, size, size), at);
    for (tf::face& f : mesh.faces) std::swap(f[1], f[2]);
    return mesh;
}

}  // namespace

TEST_CASE("components are compact meshes with the numbers of the whole") {
    std::vector<tf::mesh> boxes;
    for (int i = 0; i < 5; ++i)
        boxes.push_back(test::moved(test::box(i + 1, 1, 1), {0, 3.0 * i, 0}));
    tf::mesh all;
    for (const tf::mesh& box : boxes) all = test::together(all, box);
    all.points.push_back({9, 9, 9});  // of no face
    test::random source(1);
    source.shuffle(all.faces);
    const std::vector<tf::mesh_part> parts = tf::components(all);
    REQUIRE(parts.size() == 5);
    std::uint32_t before = 0;
    for (const tf::mesh_part& part : parts) {
        CHECK(part.mesh.points.size() == 8);
        CHECK(part.mesh.faces.size() == 12);
        CHECK(part.volume == tf::signed_volume(part.mesh));
        CHECK(part.area == tf::surface_area(part.mesh));
        CHECK(part.face_source[0] >= before);
        before = part.face_source[0];
        for (std::size_t v = 0; v < 8; ++v)
            CHECK(part.mesh.points[v] == all.points[part.vertex_source[v]]);
        for (std::size_t f = 0; f < 12; ++f)
            for (std::size_t i = 0; i < 3; ++i)
                CHECK(part.vertex_source[part.mesh.faces[f][i]] ==
                      all.faces[part.face_source[f]][i]);
        const tf::mesh_part same = tf::submesh(all, part.face_source);
        CHECK(same.mesh == part.mesh);
        CHECK(same.vertex_source == part.vertex_source);
    }
    CHECK(tf::components(all, 3.0).size() == 3);
    const std::vector<tf::mesh_part> two = tf::components(all, 0.0, 2);
    REQUIRE(two.size() == 2);
    CHECK(two[0].volume + two[1].volume == 9.0);
    CHECK(tf::components(tf::mesh{}).empty());
    CHECK_THROWS_AS((void)tf::components(all, -1.0), std::invalid_argument);
}

TEST_CASE("cavities go with what is around them") {
    const tf::mesh solid = test::together(
        test::together(test::box(8, 8, 8), cavity(6, {1, 1, 1})),
        test::together(test::moved(test::box(4, 4, 4), {2, 2, 2}), cavity(2, {3, 3, 3})));
    const std::vector<tf::mesh_part> parts = tf::components(solid);
    REQUIRE(parts.size() == 2);
    CHECK(parts[0].volume == 512.0 - 216.0);
    CHECK(parts[1].volume == 64.0 - 8.0);
    CHECK(parts[0].face_source.size() == 24);
    // Alone it is a part, also beside another one.
    CHECK(tf::components(test::together(test::box(1, 1, 1), cavity(1, {5, 0, 0}))).size() == 2);
}

TEST_CASE("corners with equal coordinates link; open parts have no volume") {
    tf::mesh soup;
    for (const tf::face& f : test::box(1, 1, 1).faces) {
        const auto first = static_cast<std::uint32_t>(soup.points.size());
        for (const std::uint32_t c : f) soup.points.push_back(test::box(1, 1, 1).points[c]);
        soup.faces.push_back({first, first + 1, first + 2});
    }
    tf::mesh open = test::moved(test::box(9, 9, 9), {20, 20, 20});
    open.faces.pop_back();
    const tf::mesh both = test::together(open, soup);
    CHECK(tf::components(both).size() == 2);
    const std::vector<tf::mesh_part> largest = tf::components(both, 0.0, 1);
    REQUIRE(largest.size() == 1);
    CHECK(largest[0].volume == 1.0);
    CHECK(tf::components(both, 0.5).size() == 1);
}

TEST_CASE("meshes one after the other, and moved") {
    const tf::mesh box = test::box(1, 2, 3);
    const std::array<tf::mesh_view, 3> three{box, tf::mesh_view{}, box};
    const tf::mesh all = tf::concatenate(three);
    CHECK(all == test::together(box, box));
    tf::transform<3> mirror;
    mirror.rows[0] = {-2, 0, 0, 5};
    const tf::mesh moved = tf::transform_mesh(box, mirror);
    CHECK(tf::signed_volume(moved) == 12.0);
    CHECK(moved.points[0] == tf::point3{5, 0, 0});
    CHECK(tf::transform_mesh(box, {}) == box);
}

TEST_CASE("mass properties are those of boxes and balls, wherever they are") {
    for (const tf::point3& at : {tf::point3{}, {-1, -1, -1.5}, {1e6, -2e6, 3e6}}) {
        const auto found = tf::find_mass_properties(test::moved(test::box(1, 2, 3), at));
        REQUIRE(found.has_value());
        CHECK(found->volume == 6.0);
        CHECK(found->center == tf::point3{at.x + 0.5, at.y + 1, at.z + 1.5});
        const std::array<std::array<double, 3>, 3> expected{{{6.5, 0, 0}, {0, 5, 0}, {0, 0, 2.5}}};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                CHECK(std::abs(found->inertia[i][j] - expected[i][j]) < 1e-14);
    }
    const auto ball = tf::find_mass_properties(test::ball(6, 2.0));
    REQUIRE(ball.has_value());
    CHECK(ball->inertia[0][0] == doctest::Approx(0.4 * ball->volume * 4).epsilon(2e-3));
    // A tetrahedron has products of inertia; turned over, all but the center is negative.
    tf::mesh corner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                    {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    const auto one = tf::find_mass_properties(corner);
    for (tf::face& f : corner.faces) std::swap(f[1], f[2]);
    const auto back = tf::find_mass_properties(corner);
    REQUIRE(one.has_value());
    REQUIRE(back.has_value());
    CHECK(one->inertia[0][0] == doctest::Approx(1.0 / 80).epsilon(1e-14));
    CHECK(one->inertia[0][1] == doctest::Approx(1.0 / 480).epsilon(1e-14));
    CHECK(one->center.x == doctest::Approx(0.25).epsilon(1e-15));
    CHECK(back->volume == -one->volume);
    CHECK(back->center == one->center);
    CHECK(back->inertia[0][1] == -one->inertia[0][1]);
    CHECK_FALSE(tf::find_mass_properties(tf::mesh{}).has_value());
    // Boxes that cancel each other, but for rounding: no volume, and no center out of noise.
    tf::mesh turned = test::moved(test::box(0.1, 0.7, 0.3), {0.2, 0.1, 0.3});
    const tf::mesh ahead = turned;
    for (tf::face& f : turned.faces) std::swap(f[1], f[2]);
    std::ranges::rotate(turned.faces, turned.faces.begin() + 5);
    turned.points[0].x += 0x1p-54;
    CHECK_FALSE(tf::find_mass_properties(test::together(ahead, turned)).has_value());
    CHECK_FALSE(tf::find_mass_properties(test::box(1e200, 1e200, 1e200)).has_value());
    const auto thin = tf::find_mass_properties(test::box(1, 1, 1e-9));
    REQUIRE(thin.has_value());
    CHECK(thin->center == tf::point3{0.5, 0.5, 0.5e-9});
}
