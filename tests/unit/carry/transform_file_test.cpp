// A file that is moved, and mirrored.

#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <span>
#include <string>
#include <vector>

namespace {

/// A pyramid over a square, with normals and texture coordinates of corners.
const std::string pyramid =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 -1\n"
    "vn 1 0 1\nf 4/4/1 3/3/1 2/2/1 1/1/1\nf 1 2 5\nf 2//2 3//2 5//2\nf 3 4 5\nf 4 1 5\n";

tf::mesh_file pyramid_file() { return tf::read(std::as_bytes(std::span(pyramid)), "a.obj", "obj"); }

std::string as_obj(const tf::mesh_file& file) {
    return tf::write_to_memory(file, {.format = "obj"});
}

const tf::transform<3> along_x{{{{-1, 0, 0, 3}, {0, 1, 0, 0}, {0, 0, 1, 0}}}};

}  // namespace

TEST_CASE("transform_file: a mirror turns faces over, polygons stay polygons") {
    tf::mesh_file file = pyramid_file();
    const double volume = tf::signed_volume(file.mesh);
    REQUIRE(volume > 0.0);
    file.move(along_x);
    CHECK(tf::signed_volume(file.mesh) == volume);
    CHECK(as_obj(file) ==
          "v 3 0 0\nv 2 0 0\nv 2 1 0\nv 3 1 0\nv 3 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
          "vn 0 0 -1\nvn -1 0 1\nf 4/4/1 1/1/1 2/2/1 3/3/1\nf 1 5 2\nf 2//2 5//2 3//2\n"
          "f 3 5 4\nf 4 5 1\n");
    file.move(along_x);
    CHECK(as_obj(file) == as_obj(pyramid_file()));
}

TEST_CASE("transform_file: what does not mirror leaves faces as they are") {
    tf::mesh_file file = pyramid_file();
    file.move(tf::transform<3>{{{{-2, 0, 0, 0}, {0, -2, 0, 0}, {0, 0, 2, 0}}}});
    CHECK(file.mesh.faces == pyramid_file().mesh.faces);
    CHECK(file.mesh.points[2] == tf::point3{-2, -2, 0});
    tf::mesh_file cloud{.mesh = {.points = {{1, 2, 3}}, .faces = {}}};
    cloud.move(along_x);
    CHECK(cloud.mesh.points[0] == tf::point3{2, 2, 3});
}

TEST_CASE("file_parts: solids that touch are parts, patches of one surface are one") {
    const std::string box =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
    const std::string other =
        "v 1 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\n";
    const std::string sides =
        "f -5 -6 -7 -8\nf -4 -3 -2 -1\nf -8 -7 -3 -4\nf -7 -6 -2 -3\nf -6 -5 -1 -2\nf -5 -8 -4 "
        "-1\n";
    const auto parts_of_obj = [](const std::string& text) {
        const tf::mesh_file file = tf::read(std::as_bytes(std::span(text)), "a.obj", "obj");
        return tf::file_parts({&file, {}}, true);
    };
    const auto two = parts_of_obj(box + "o one\n" + sides + other + "o two\n" + sides);
    REQUIRE(two.size() == 2);
    CHECK(two[0].name == "one");
    CHECK(two[1].name == "two");
    CHECK(tf::signed_volume(two[1].file.mesh) == doctest::Approx(1.0));
    CHECK(two[1].face_in_file.front() == 6);
    // The same box, its first side with points of its own.
    const auto patches =
        parts_of_obj(box + "g low\n" + sides.substr(0, 15) + box + "g rest\n" + sides.substr(15));
    CHECK(patches.size() == 1);
    CHECK(parts_of_obj(box + sides).size() == 1);
}
