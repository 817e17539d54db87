#include <treeform/mesh/as_mesh.hpp>
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
    CHECK(m.dropped == 0);
    CHECK(m.face_in_file(1) == 1);
}

TEST_CASE(
    "as_mesh: faces that are not finite go, and the rest is known by the numbers of the file") {
    tf::mesh_file file = file_of({{{NAN, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {INFINITY, 1, 0}},
                                  {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 2, 1}}});
    file.stored_face = {0, 1, 1, 2};
    const tf::usable_mesh m = tf::as_mesh(file);
    CHECK(m.mesh.faces == std::vector<tf::face>{{1, 2, 3}, {3, 2, 1}});
    CHECK(m.triangle_of_face == std::vector<std::uint32_t>{1, 3});
    CHECK(m.dropped == 2);
    CHECK(m.face_in_file(0) == 1);
    CHECK(m.face_in_file(1) == 2);
    // Ready for what refuses a NaN; the 0 that stands for it joins nothing.
    CHECK(tf::self_intersections(m).pairs ==
          std::vector<tf::face_pair>{{0, 1, tf::pair_kind::duplicate}});
}

TEST_CASE("as_mesh: of nothing nothing, and a corner that is no vertex is refused") {
    CHECK(tf::as_mesh({}).mesh == tf::mesh{});
    CHECK_THROWS_WITH_AS(static_cast<void>(tf::as_mesh(file_of({{{0, 0, 0}}, {{0, 0, 1}}}))),
                         "treeform::as_mesh: face 0 has a corner out of range",
                         std::invalid_argument);
}
