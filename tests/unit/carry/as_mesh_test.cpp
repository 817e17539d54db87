#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace {

tf::mesh_file file_of(tf::mesh mesh) {
    tf::mesh_file file;
    file.stored_faces = mesh.faces.size();
    file.mesh = std::move(mesh);
    return file;
}

}  // namespace

TEST_CASE("as_mesh: equal corners become the lowest of them, under the numbers of the file") {
    const tf::usable_mesh m =
        tf::as_mesh(file_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {-0.0, 1, 0}},
                             {{0, 1, 2}, {3, 4, 5}}}));
    CHECK(m.mesh.points.size() == 6);
    CHECK(m.mesh.faces == std::vector<tf::face>{{0, 1, 2}, {1, 4, 2}});
    CHECK(m.triangle_of_face.empty());
    CHECK(m.non_finite == 0);
    CHECK(m.face_in_file(1) == 1);
}

TEST_CASE("as_mesh: points of a cloud that are not finite go, and are counted") {
    const tf::usable_mesh m =
        tf::as_mesh(file_of({{{NAN, 0, 0}, {1, 0, 0}, {0, INFINITY, 0}, {2, 0, 0}}, {}}));
    CHECK(m.mesh.points == std::vector<tf::point3>{{1, 0, 0}, {2, 0, 0}});
    CHECK(m.non_finite == 2);
    CHECK(tf::usable_faces({{{NAN, 0, 0}, {1, 0, 0}}, {}}, {}).mesh.points.size() == 1);
    const tf::mesh joined = tf::join_meshes(std::vector<tf::mesh_view>{m.mesh, {}});
    CHECK(joined.points.size() == 2);
}

TEST_CASE(
    "as_mesh: faces that are not finite go, and the rest is known by the numbers of the file") {
    tf::mesh_file file = file_of({{{NAN, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {INFINITY, 1, 0}},
                                  {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 2, 1}}});
    file.face_of_triangle = {0, 1, 1, 2};
    const tf::usable_mesh m = tf::as_mesh(file);
    CHECK(m.mesh.faces == std::vector<tf::face>{{1, 2, 3}, {3, 2, 1}});
    CHECK(m.triangle_of_face == std::vector<std::uint32_t>{1, 3});
    CHECK(m.non_finite == 2);
    CHECK(m.face_in_file(0) == 1);
    CHECK(m.face_in_file(1) == 2);
    // Ready for what refuses a NaN; the point that stands for it joins nothing.
    CHECK(tf::self_intersections(m).pairs ==
          std::vector<tf::face_pair>{{0, 1, tf::pair_kind::duplicate}});
}

TEST_CASE("as_mesh: points that are not finite do not widen the box") {
    const tf::usable_mesh m = tf::as_mesh(
        file_of({{{NAN, 9, 9}, {5, 5, 5}, {6, 5, 5}, {5, 6, 5}}, {{0, 1, 2}, {1, 2, 3}}}));
    CHECK(tf::bounding_box(m.mesh.points) == tf::box3{{5, 5, 5}, {6, 6, 5}});
}

TEST_CASE("as_mesh: of nothing nothing, and a corner that is no vertex is refused") {
    CHECK(tf::as_mesh({}).mesh == tf::mesh{});
    CHECK_THROWS_WITH_AS(static_cast<void>(tf::as_mesh(file_of({{{0, 0, 0}}, {{0, 0, 1}}}))),
                         doctest::Contains("treeform::as_mesh: face 0 has a corner out of range"),
                         std::invalid_argument);
}

TEST_CASE("usable_faces: a box cuts the search down, and faces keep the way back to the file") {
    tf::mesh_file file = file_of(
        {{{NAN, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}, {9, 8, 9}, {8, 9, 9}, {1, 0, 0}},
         {{0, 1, 2}, {4, 5, 6}, {1, 7, 3}}});
    const tf::box3 box{{-1, -1, -1}, {2, 2, 2}};
    const tf::usable_mesh part =
        tf::usable_faces(file.mesh, {0, 4, 7}, {.box = box, .details = true});
    CHECK(part.mesh.faces.size() == 1);
    CHECK(part.triangle(0) == 2);
    CHECK(part.face_in_file(0) == 7);
    CHECK(part.non_finite == 1);
    CHECK(part.component == std::vector<std::uint32_t>{1});
    CHECK(tf::usable_faces(file.mesh, {}, {.tolerance = 0.0}).mesh.faces.size() == 2);
}

TEST_CASE("join_meshes: equal points of several meshes are one") {
    const tf::mesh a{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    const tf::mesh b{{{0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {NAN, 0, 0}}, {{0, 1, 2}}};
    const std::vector<tf::mesh_view> both{a, b};
    const tf::mesh all = tf::join_meshes(both);
    CHECK(all.faces == std::vector<tf::face>{{0, 1, 2}, {2, 1, 3}});
}

TEST_CASE("marks: a face shows the gravest of its pairs, faces that were left out none") {
    tf::mesh_file file =
        file_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}},
                 {{0, 1, 2}, {3, 4, 5}, {0, 2, 1}}});
    const std::vector<tf::face_pair> pairs{{0, 2, tf::pair_kind::duplicate}};
    const auto regions = tf::group_pairs(file.mesh, pairs);
    const tf::face_marks marks = tf::face_marks(3, pairs, regions);
    CHECK(marks.kind == std::vector<std::uint8_t>{4, 0, 4});
    CHECK(marks.region == std::vector<std::int32_t>{0, -1, 0});
    marks.color(file, tf::as_mesh(file));
    const tf::element* const faces = file.attributes.find("face");
    REQUIRE(faces != nullptr);
    CHECK(faces->find("tf_class")->number(2) == 4.0);
    CHECK(faces->find("red")->number(1) == 0xb4);
}
