#include <treeform/mesh/align.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/pack.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using test::box;
using test::moved;

tf::mesh_file file_of(tf::mesh mesh) {
    tf::mesh_file file;
    file.stored_faces = mesh.faces.size();
    file.mesh = std::move(mesh);
    return file;
}

}  // namespace

TEST_CASE("bodies: equal corners are one, faces that are not finite are left out") {
    tf::mesh_file file = file_of(test::unjoined(box(1, 1, 1)));
    file.mesh.points[3].x = std::numeric_limits<double>::quiet_NaN();
    tf::body_set found;
    CHECK(found.add(file).non_finite == 1);
    REQUIRE(found.shapes.size() == 1);
    CHECK(found.shapes[0].indexed_view().points.size() == 8);
    CHECK(found.shapes[0].indexed_view().faces.size() == 11);
    CHECK(found.triangle(0, 0) == 0);
    CHECK(found.triangle(0, 1) == 2);
    CHECK(found.shapes[0].indexes_built() == 0);
    CHECK_FALSE(found.add({}).box);
    CHECK(found.shapes.size() == 1);
    CHECK(found.files.size() == 2);
}

TEST_CASE("bodies: a file without faces is a cloud of its finite points") {
    tf::body_set found;
    const tf::body_file& file =
        found.add_parts(file_of({{{0, 0, 0}, {std::nan(""), 0, 0}, {1, 1, 1}}, {}}));
    REQUIRE(file.cloud);
    CHECK(file.non_finite == 1);
    CHECK(file.box->max == tf::point3{1, 1, 1});
    CHECK(found.shapes[0].is_cloud());
    CHECK(found.triangle(0, 1) == 2);
    found.move_in_file(0, std::vector<tf::point3>{{5, 5, 5}, {6, 6, 6}}, tf::transform<3>{},
                       tf::precision::float64);
    CHECK(file.content.mesh.points[0] == tf::point3{5, 5, 5});
    CHECK(file.content.mesh.points[2] == tf::point3{6, 6, 6});
}

TEST_CASE("bodies: each part of a file is the mesh of its faces alone") {
    const tf::mesh both = test::together(moved(box(1, 1, 1), {5, 0, 0}), box(2, 2, 2));
    tf::mesh_file file = file_of(both);
    file.attributes.parts = {{.object = "small", .first_face = 0}, {.first_face = 12}};
    tf::body_set found;
    const tf::body_file& first = found.add(file, "whole.obj");
    CHECK(found.add_parts(file, "parts.obj").box == first.box);
    CHECK(first.label == "whole.obj");
    REQUIRE(found.shapes.size() == 3);
    CHECK(found.labels() ==
          std::vector<std::string>{"whole.obj", "parts.obj: small", "parts.obj: part 1"});
    for (std::size_t i = 1; i < 3; ++i) {
        const tf::mesh_view view = found.shapes[i].indexed_view();
        std::vector<std::uint32_t> triangles;
        for (std::uint32_t f = 0; f < view.faces.size(); ++f)
            triangles.push_back(found.triangle(i, f));
        const tf::mesh expected = tf::submesh(both, triangles).mesh;
        CHECK(tf::mesh{{view.points.begin(), view.points.end()},
                       {view.faces.begin(), view.faces.end()}} == expected);
        CHECK(found.file_number(i) == 1);
        CHECK(found.face_in_file(i, 0) == 12 * (i - 1));
    }
    file.attributes.parts[1].object = "small";
    found.add_parts(file);
    CHECK(found.shapes.size() == 4);
    CHECK(found.label(3).empty());
}

TEST_CASE("bodies: points go back to where they are in the file, others move along") {
    tf::mesh_file file = file_of(test::unjoined(box(1, 1, 1)));
    file.mesh.points.push_back({0.1, 7, 7});
    tf::body_set found;
    tf::mesh_file& there = found.add(std::move(file)).content;
    std::vector<tf::point3> placed(found.shapes[0].indexed_view().points.begin(),
                                   found.shapes[0].indexed_view().points.end());
    for (tf::point3& p : placed) p.z += 4;
    tf::transform<3> up;
    up.rows[2][3] = 4;
    found.move_in_file(0, placed, up, tf::precision::float32);
    const tf::mesh expected = moved(test::unjoined(box(1, 1, 1)), {0, 0, 4});
    for (std::size_t i = 0; i < expected.points.size(); ++i)
        CHECK(there.mesh.points[i] == expected.points[i]);
    CHECK(there.mesh.points.back() == tf::point3{double{0.1F}, 7, 11});
    CHECK(there.round_to_float32() == 0.0);
    there.mesh.points.back().x = 0.1;
    CHECK(there.round_to_float32() == double{0.1F} - 0.1);
}

TEST_CASE("bodies: how they lie to each other, in words, with the numbers of their files") {
    tf::body_set moving, fixed;
    tf::mesh_file cube = file_of(box(1, 1, 1));
    for (std::uint32_t t = 0; t < 12; ++t) cube.face_of_triangle.push_back(50 + t);
    moving.add(cube, "cube.obj");
    fixed.add(file_of(moved(box(1, 1, 1), {0.5, 0.5, 1})), "on.obj");
    fixed.add(file_of({{{0.5, 0.5, 3}}, {}}), "cloud.ply");
    const auto words = [&](std::size_t first, std::size_t count, double clearance) {
        const auto among = std::span<const tf::prepared_mesh>(fixed.shapes).subspan(first, count);
        const auto at = tf::measure_in_place(moving.shapes[0], among, {.clearance = clearance});
        return at.relation_in_words(moving, fixed);
    };
    const std::string text = words(0, 2, 0);
    CHECK(text.starts_with("touching on.obj ("));
    CHECK(text.find("pairs of faces, the first 5") != std::string::npos);
    CHECK(words(0, 0, 0) == "disjoint");
    CHECK(words(0, 0, 1) == "clear");
    tf::body_set cloud;
    std::swap(fixed, cloud);
    fixed.add(cloud.files[1].content, "cloud.ply");
    CHECK(words(0, 1, 0) == "disjoint, 2 from cloud.ply");
    CHECK(words(0, 1, 2.5) == "closer-than-clearance, 2 from cloud.ply");
    fixed = {};
    fixed.add(file_of({{{0.5, 0.5, 1}}, {}}), "cloud.ply");
    CHECK(words(0, 1, 0).find("of a face and a point, the first 5") != std::string::npos);
    fixed = {};
    fixed.add(file_of(moved(box(3, 3, 3), {-1, -1, -1})), "around.obj");
    CHECK(words(0, 1, 0) == "penetrating around.obj, inside it");
    CHECK(tf::drop(moving.shapes[0]).relation_in_words(moving, {}) == "touching the bed");
}

TEST_CASE("what has been laid flat or aligned says so in words") {
    CHECK(tf::lay_flat(box(1, 2, 3))->message() == "on side 0 of 6, of area 6");
    CHECK(tf::laid_flat{}.message().empty());
    CHECK(tf::align_result{.rms = 0.5,
                           .overlap = 1,
                           .outcome = tf::align_outcome::out_of_iterations,
                           .iterations = 1}
              .message() ==
          "not converged after 1 step; rms 0.5, from 0; overlap 1; more "
          "iterations may help");
}

TEST_CASE(
    "relations in files: those of bodies, by file, and of clouds only where they are wanted") {
    using tf::mesh_relation;
    tf::body_set moving, fixed;
    moving.add(file_of(box(1, 1, 1)));
    tf::mesh_file parts =
        file_of(test::together(moved(box(1, 1, 1), {5, 0, 0}), moved(box(1, 1, 1), {9, 0, 0})));
    parts.attributes.parts = {{.object = "a", .first_face = 0}, {.object = "b", .first_face = 12}};
    fixed.add(file_of({{{0, 0, 9}}, {}}));
    fixed.add_parts(parts);
    using relations = std::vector<mesh_relation>;
    const std::vector<relations> of_moving{relations(12, mesh_relation::closer_than_clearance)};
    const std::vector<relations> of_fixed{
        {mesh_relation::closer_than_clearance}, {}, relations(12, mesh_relation::touching)};
    CHECK(moving.relations_in_files(of_moving, true) == of_moving[0]);
    relations expected(24);
    std::fill_n(expected.begin() + 12, 12, mesh_relation::touching);
    CHECK(fixed.relations_in_files(of_fixed, false) == expected);
    expected.insert(expected.begin(), mesh_relation::closer_than_clearance);
    CHECK(fixed.relations_in_files(of_fixed, true) == expected);
    tf::body_set cloud;
    cloud.add(file_of({{{0, 0, 9}}, {}}));
    const std::vector<relations> of_cloud{relations{mesh_relation::touching}};
    CHECK(cloud.relations_in_files(of_cloud, true) == of_cloud[0]);
}

TEST_CASE("contact colors: a stored face has the gravest class of its triangles") {
    using tf::mesh_relation;
    tf::mesh_file file = file_of(box(1, 1, 1));
    file.face_of_triangle = {0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5};
    file.stored_faces = 6;
    std::vector<mesh_relation> relations(12);
    relations[2] = mesh_relation::closer_than_clearance;
    relations[3] = mesh_relation::touching;
    relations[4] = mesh_relation::penetrating;
    tf::mesh_file picture = file;
    const auto numbers = [](const tf::mesh_file& from) {
        std::vector<double> found;
        const tf::element* const rows = from.attributes.find("face");
        for (std::size_t i = 0; i < rows->rows; ++i)
            found.push_back(rows->find("tf_class")->number(i));
        return found;
    };
    tf::placement::color(file, relations);
    CHECK(numbers(file) == std::vector<double>{0, 2, 1, 0, 0, 0});
    picture.split_polygons();
    tf::placement::color(picture, relations);
    CHECK(numbers(picture) == std::vector<double>{0, 0, 3, 2, 1, 0, 0, 0, 0, 0, 0, 0});
    CHECK_THROWS_AS(tf::placement::color(file, {}), std::invalid_argument);
}

TEST_CASE("rounding effects: far away float32 folds what it has not folded before") {
    const tf::mesh ball = test::ball(3, 1e-3);
    tf::transform<3> away;
    away.rows[0][3] = away.rows[1][3] = 1e4;
    const auto written = [&](tf::precision precision) {
        std::vector<tf::point3> placed;
        for (const tf::point3& p : ball.points) {
            const double x = p.x + 1e4, y = p.y + 1e4;
            placed.push_back(precision == tf::precision::float32
                                 ? tf::point3{double{static_cast<float>(x)},
                                              double{static_cast<float>(y)},
                                              double{static_cast<float>(p.z)}}
                                 : tf::point3{x, y, p.z});
        }
        return tf::find_rounding_effects(ball, away, placed, tf::precision::float64, precision);
    };
    const auto exact = written(tf::precision::float64);
    CHECK_FALSE(exact.noticeable);
    CHECK(exact.max_displacement < 1e-11);
    CHECK(exact.compared);
    CHECK(exact.collapsed == 0);
    const auto rounded = written(tf::precision::float32);
    CHECK(rounded.noticeable);
    CHECK(rounded.compared);
    CHECK(rounded.collapsed > 0);
    CHECK(rounded.max_displacement > 1e-5);
    CHECK_THROWS_AS(static_cast<void>(tf::find_rounding_effects(ball, away, {})),
                    std::invalid_argument);
}

TEST_CASE("bodies: what is around a contact has a tint, but no class") {
    tf::mesh_file file;
    file.mesh = test::ball(4, 1.0);
    std::vector<tf::mesh_relation> relations(file.mesh.faces.size());
    relations[0] = tf::mesh_relation::touching;
    const auto yellow = [&](double halo) {
        tf::mesh_file colored = file;
        tf::placement::color(colored, relations, halo);
        const tf::element* const rows = colored.attributes.find("face");
        REQUIRE(rows != nullptr);
        std::size_t tinted = 0, classed = 0;
        for (std::size_t f = 0; f < relations.size(); ++f) {
            tinted += rows->find("blue")->number(f) < rows->find("red")->number(f);
            classed += rows->find("tf_class")->number(f) != 0.0;
        }
        CHECK(classed == 1);
        return tinted;
    };
    CHECK(yellow(0.0) == 1);
    CHECK(yellow(0.2) > 8);
    CHECK(yellow(0.2) < yellow(0.5));
    CHECK(yellow(3.0) == relations.size());
}
