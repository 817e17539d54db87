#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/columns.hpp>
#include <support/models.hpp>
#include <support/soups.hpp>

#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

/// Clouds, files and lists of files: what is welded besides meshes.

namespace {

using test::vertex_columns;
using ids = std::vector<std::uint32_t>;

/// A square and a triangle on one of its edges; the ends of that edge are there twice.
tf::mesh_file square_and_triangle() {
    tf::mesh_file file;
    file.mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                        {1, 0, 0}, {2, 0, 0}, {1, 1, 0}};
    file.mesh.faces = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}};
    file.face_of_triangle = {0, 0, 1};
    file.stored_faces = 2;
    return file;
}

tf::mesh_file cloud_of(std::vector<tf::point3> points, tf::attributes attributes = {}) {
    tf::mesh_file file;
    file.mesh.points = std::move(points);
    file.attributes = std::move(attributes);
    return file;
}

}  // namespace

TEST_CASE("weld: a cloud keeps its first points and their properties") {
    const std::vector<tf::point3> points{{0, 0, 0}, {5, 0, 0}, {0.5, 0, 0}};
    const auto welded = tf::weld(points, vertex_columns({{"q", {7, 8, 9}}}), {.tolerance = 0.5});
    CHECK(welded.status == tf::status::ok);
    CHECK(welded.mesh.points == std::vector<tf::point3>{{0, 0, 0}, {5, 0, 0}});
    CHECK(welded.attributes == vertex_columns({{"q", {7, 8}}}));
    CHECK(welded.groups.group_of_point == ids{0, 1, 0});
    CHECK(welded.statistics.groups == 1);
    CHECK(welded.statistics.max_displacement == 0.5);
    CHECK(tf::weld(points, {.tolerance = 0.25}).mesh.points == points);
}

TEST_CASE("weld: one line will do, for a mesh and for a prepared one") {
    const tf::mesh soup = tf::read(test::data_folder() / "cube.stl").mesh;
    const auto welded = tf::weld(soup);
    CHECK(welded.mesh.points.size() == 8);
    CHECK(tf::weld(tf::prepared_mesh::borrow(soup)).mesh == welded.mesh);
    CHECK(tf::weld(soup, {.tolerance = 0.001}).mesh == welded.mesh);
}

TEST_CASE("weld: points that are not finite are counted") {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<tf::point3> points{{0, nan, 0}, {0, 0, 0}, {0, nan, 0}};
    const auto welded = tf::weld(points, {.tolerance = 1.0});
    CHECK(welded.statistics.non_finite == 2);
    CHECK(welded.mesh.points.size() == 3);
}

TEST_CASE("weld: the polygons of a file are polygons again") {
    const tf::mesh_file file = square_and_triangle();
    const auto welded = tf::weld(file);
    CHECK(welded.file.mesh.points.size() == 5);
    CHECK(welded.file.mesh.faces.size() == 3);
    CHECK(welded.file.face_of_triangle == ids{0, 0, 1});
    CHECK(welded.file.stored_faces == 2);
    CHECK(welded.groups.group_of_point == ids{0, 1, 2, 3, 1, 4, 2});
    CHECK(welded.face_source == ids{0, 1, 2});
}

TEST_CASE("weld: the groups of a soup are those of its corners") {
    const tf::mesh_file file = tf::read(test::data_folder() / "cube.stl");
    const auto welded = tf::weld(file);
    CHECK(welded.file.indexed);
    CHECK(welded.file.format == file.format);
    CHECK(welded.groups.group_of_point.size() == file.mesh.points.size());
    CHECK(welded.vertex_source.size() == 8);
    CHECK(welded.statistics.groups == 8);
    for (std::uint32_t g = 0; g < 8; ++g)
        CHECK(file.mesh.points[welded.vertex_source[g]] == welded.file.mesh.points[g]);
}

TEST_CASE("weld: seams of a mesh are kept when asked for, except for those across") {
    const tf::mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}}, {{0, 1, 2}, {3, 1, 2}}};
    const auto properties = vertex_columns({{"nx", {1, 0, 0, 2}}, {"u", {0, 0, 0, 0}}});
    const auto points_left = [&](const tf::weld_options& options) {
        return tf::weld(mesh, properties, options).mesh.points.size();
    };
    CHECK(points_left({}) == 3);
    CHECK(points_left({.keep_seams = true}) == 4);
    CHECK(points_left({.keep_seams = true, .ignored_seams = {"normal"}}) == 3);
    CHECK(points_left({.keep_seams = true, .ignored_seams = {"uv", "color"}}) == 4);
    CHECK(points_left({.same = {{"normal", 1.0}}, .keep_seams = true}) == 3);
    CHECK(points_left({.same = {{"normal", 0.5}}}) == 4);
    CHECK(tf::weld(mesh.points, properties, {.keep_seams = true}).mesh.points.size() == 3);
    CHECK(tf::weld_options{.same = {{"normal"}}, .keep_seams = true}
              .conditions(properties, true)
              .size() == 2);
}

TEST_CASE("weld: an error says which option names which property") {
    const tf::mesh mesh{{{0, 0, 0}}, {}};
    const auto refused = [&](const tf::attributes& properties, const tf::weld_options& options,
                             const std::string& option, const std::string& reason) {
        try {
            static_cast<void>(tf::weld(mesh, properties, options));
            FAIL("not refused");
        } catch (const tf::weld_property_error& error) {
            CHECK(error.option() == option);
            CHECK(error.reason() == reason);
        }
    };
    refused({}, {.same = {{"q"}}}, "same", "");
    refused({}, {.keep_seams = true, .ignored_seams = {"q"}}, "ignored_seams", "");
    refused(vertex_columns({{"nx", {0}}, {"ny", {0}}}),
            {.keep = tf::weld_keep::lowest, .keep_by = "normal"}, "keep_by",
            "is more than one property");
}

TEST_CASE("withhold: flags what is not kept and leaves other flags and points as they are") {
    const std::vector<tf::point3> points{{0, 0, 0}, {5, 0, 0}, {0, 0, 0}, {5, 0, 0}, {9, 0, 0}};
    const auto flags = [&](const tf::attributes& properties) {
        tf::mesh_file file = cloud_of(points, properties);
        tf::weld(file).withhold(file);
        CHECK(file.mesh.points == points);
        const tf::column* const c = file.attributes.find("vertex")->find("withheld");
        REQUIRE(c != nullptr);
        CHECK(c->type == tf::scalar_type::uint8);
        std::vector<double> values;
        for (std::size_t i = 0; i < c->size(); ++i) values.push_back(c->number(i));
        return values;
    };
    CHECK(flags({}) == std::vector<double>{0, 0, 1, 1, 0});
    CHECK(flags(vertex_columns({{"withheld", {1, 0, 0, 1, 0}}})) ==
          std::vector<double>{1, 0, 1, 1, 0});
    tf::mesh_file other = cloud_of({{0, 0, 0}});
    CHECK_THROWS_AS(tf::weld(cloud_of(points)).withhold(other), std::invalid_argument);
}

TEST_CASE("count_mergeable: rounding and the choice of what is kept bring points together") {
    const double step = std::numeric_limits<float>::epsilon();
    tf::mesh_file file = cloud_of({{1.0, 0, 0}, {1.0 + step / 4, 0, 0}});
    CHECK(tf::count_mergeable(file, {}, tf::precision::float64) == 0);
    CHECK(tf::count_mergeable(file, {}, tf::precision::float32) == 1);
    file = cloud_of({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}});
    const tf::weld_options mean{.tolerance = 1.0, .keep = tf::weld_keep::mean};
    CHECK(tf::count_mergeable(file, mean, tf::precision::float64) == 1);
    CHECK_FALSE(tf::count_mergeable(file, {.only_borders = true}, tf::precision::float64));
}

TEST_CASE("join: points and faces follow each other, columns go together by name") {
    const tf::mesh_file a = cloud_of({{0, 0, 0}}, vertex_columns({{"q", {1}}}));
    const tf::mesh_file b = square_and_triangle();
    const std::vector<std::string> names{"a.ply", "b.ply"};
    const tf::mesh_file all = tf::concatenate_files({a, b}, names);
    CHECK(all.mesh.points.size() == 8);
    CHECK(all.mesh.faces.front() == tf::face{1, 2, 3});
    CHECK(all.stored_faces == 2);
    const tf::element* const vertices = all.attributes.find("vertex");
    REQUIRE(vertices != nullptr);
    CHECK(vertices->rows == 8);
    REQUIRE(all.warnings.size() == 1);
    CHECK(all.warnings[0].text == "b.ply: no vertex property q; filled with NaN");
    CHECK(tf::concatenate_files({}, {}).mesh == tf::mesh{});
    CHECK_THROWS_AS(static_cast<void>(tf::concatenate_files({a}, names)), std::invalid_argument);
}
