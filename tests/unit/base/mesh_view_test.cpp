#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

TEST_CASE("mesh_view::of: arrays of numbers are viewed as points and faces, without a copy") {
    const std::vector<double> flat{0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::vector<std::uint32_t> corners{0, 1, 2, 2, 1, 0};
    const tf::mesh_view view = tf::mesh_view::of(flat, corners);
    REQUIRE(view.points.size() == 3);
    REQUIRE(view.faces.size() == 2);
    CHECK(static_cast<const void*>(view.points.data()) == flat.data());
    CHECK(static_cast<const void*>(view.faces.data()) == corners.data());
    CHECK(view.points[1] == tf::point3{1, 0, 0});
    CHECK(view.faces[1] == tf::face{2, 1, 0});
}

TEST_CASE("mesh_view::of: rows, spans, signed numbers, and points alone") {
    const std::vector<std::array<double, 3>> rows{{0, 0, 0}, {1, 2, 3}};
    const std::array<std::int32_t, 3> corners{0, 1, 1};
    const std::array<tf::face, 1> faces{{{0, 1, 1}}};
    const std::vector<tf::point3> points{{0, 0, 0}, {1, 2, 3}};
    CHECK(tf::mesh_view::of(rows, corners).points[1] == tf::point3{1, 2, 3});
    CHECK(tf::mesh_view::of(rows, corners).faces[0] == tf::face{0, 1, 1});
    CHECK(tf::mesh_view::of(std::span(rows.data()->data(), 6), faces).points[1].z == 3.0);
    CHECK(tf::mesh_view::of(points, faces).points.data() == points.data());
    CHECK(tf::mesh_view::of(rows).faces.empty());
    CHECK(tf::mesh_view::of(std::span<const double>{}).points.empty());
}

TEST_CASE("mesh_view::of: numbers that are not rows of three are refused") {
    const std::vector<double> flat{0, 0, 0, 1};
    const std::vector<std::uint32_t> corners{0, 0};
    CHECK_THROWS_WITH_AS((void)tf::mesh_view::of(flat),
                         "treeform::mesh_view::of: 4 numbers are not rows of three",
                         std::invalid_argument);
    CHECK_THROWS_AS((void)tf::mesh_view::of(std::span<const double>{}, corners),
                    std::invalid_argument);
}

TEST_CASE("box3::mesh: a solid of the box") {
    const tf::mesh box = tf::box3{{1, 2, 3}, {2, 4, 6}}.mesh();
    CHECK_FALSE(tf::find_solid_defects(box).any());
    CHECK(tf::signed_volume(box) == doctest::Approx(6.0));
    CHECK(*tf::bounding_box(box.points) == tf::box3{{1, 2, 3}, {2, 4, 6}});
}

TEST_CASE("rays: origins and directions are points, too") {
    const tf::ray3 ray{tf::point3{1, 2, 3}, tf::point3{0, 0, 1}};
    CHECK((ray.origin[2] == 3.0 && ray.direction[2] == 1.0));
}
