// GLB is written with all that it has a place for, and says what it has none for.

#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/own_folder.hpp>

#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace {

/// Two triangles that are a square.
tf::mesh_file glb_square() {
    tf::mesh_file file;
    file.mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    file.mesh.faces = {{0, 1, 2}, {0, 2, 3}};
    file.stored_faces = 2;
    file.stored_as = tf::precision::float32;
    return file;
}

template <class T>
void add_to_points(tf::mesh_file& file, const char* name, const std::vector<T>& values) {
    file.attributes.find_or_add("vertex", file.mesh.points.size())
        .columns.push_back(tf::column::of<T>(name, values));
}

struct glb_written {
    tf::mesh_file again{};
    std::vector<std::string> warnings{};
    std::string bytes{};
};

glb_written through_glb(const tf::mesh_file& file) {
    const test::own_folder folder("io_glb_test");
    glb_written w;
    for (const auto& warning : tf::write(folder.path / "a.glb", file).warnings)
        w.warnings.push_back(warning.code + ": " + warning.text);
    w.again = tf::read(folder.path / "a.glb");
    w.bytes = test::bytes_of(folder.path / "a.glb");
    return w;
}

const tf::column* point_column(const tf::mesh_file& file, std::string_view name) {
    const tf::element* const vertices = file.attributes.find("vertex");
    return vertices == nullptr ? nullptr : vertices->find(name);
}

std::vector<double> column_values(const tf::mesh_file& file, std::string_view name) {
    std::vector<double> values;
    const tf::column* const c = point_column(file, name);
    for (std::size_t i = 0; c != nullptr && i < c->size(); ++i) values.push_back(c->number(i));
    return values;
}

using numbers = std::vector<double>;
using texts = std::vector<std::string>;

}  // namespace

TEST_CASE("glb: colors of points come back in their type, with alpha and without") {
    const auto check = [](auto full) {
        using number = decltype(full);
        for (const bool alpha : {false, true}) {
            tf::mesh_file file = glb_square();
            const auto half = static_cast<number>(full / 2);
            const number none{0};
            add_to_points<number>(file, "red", {full, half, none, full});
            add_to_points<number>(file, "green", {none, full, half, half});
            add_to_points<number>(file, "blue", {half, none, full, none});
            if (alpha) add_to_points<number>(file, "alpha", {full, none, half, full});
            const glb_written w = through_glb(file);
            CHECK(w.again.mesh == file.mesh);
            CHECK(w.again.attributes.elements == file.attributes.elements);
            CHECK(w.warnings.empty());
            // By which colors are multiplied: 1.
            CHECK(w.bytes.find("baseColorFactor") == std::string::npos);
        }
    };
    check(std::uint8_t{255});
    check(std::uint16_t{65535});
    check(1.0F);
}

TEST_CASE("glb: colors of other types become floats from 0 to 1") {
    tf::mesh_file file = glb_square();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const char* const name : {"red", "green", "blue"})
        add_to_points<double>(file, name, {-1, 0.25, 1, nan});
    const tf::mesh_file again = through_glb(file).again;
    CHECK(point_column(again, "red")->type == tf::scalar_type::float32);
    CHECK(column_values(again, "blue") == numbers{0, 0.25, 1, 0});
}

TEST_CASE("glb: normals and texture coordinates of points come back") {
    tf::mesh_file file = glb_square();
    add_to_points<float>(file, "nx", {0, 0, 0, 0.6F});
    add_to_points<float>(file, "ny", {0, 1, 0, 0});
    add_to_points<float>(file, "nz", {1, 0, -1, 0.8F});
    add_to_points<float>(file, "s", {0, 0.5F, 2, -1});
    add_to_points<float>(file, "t", {0.25F, 1, 0, 3});
    const glb_written w = through_glb(file);
    CHECK(w.again.attributes.elements == file.attributes.elements);
    CHECK(w.warnings.empty());
    CHECK(w.bytes.find(R"("NORMAL":1,"TEXCOORD_0":2)") != std::string::npos);
}

TEST_CASE("glb: normals get the length 1; where one has none, all are left out") {
    tf::mesh_file file = glb_square();
    add_to_points<float>(file, "nx", {0, 0, 0, 3});
    add_to_points<float>(file, "ny", {0, 2, 0, 0});
    add_to_points<float>(file, "nz", {5, 0, -1, 4});
    CHECK(column_values(through_glb(file).again, "ny") == numbers{0, 1, 0, 0});
    CHECK(column_values(through_glb(file).again, "nz")[0] == 1.0);
    file.attributes.elements.clear();
    for (const char* const name : {"nx", "ny", "nz"})
        add_to_points<float>(file, name, {1, 1, 0, 1});
    CHECK(column_values(through_glb(file).again, "nz").empty());
    CHECK(through_glb(file).warnings.size() == 1);
}

TEST_CASE("glb: points get copies where their corners differ in texture or normal") {
    tf::mesh_file file = glb_square();
    tf::corner_values& corners = file.attributes.corners;
    corners.texture = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}};
    corners.texture_of_corner = {{0, 1, 2}, {4, 2, 3}};
    corners.normals = {{0, 0, 1}, {0, 1, 0}};
    corners.normal_of_corner = {{0, 0, 0}, {0, 0, 1}};
    const glb_written w = through_glb(file);
    CHECK(w.warnings.empty());
    CHECK(w.again.mesh.points.size() == 5);
    CHECK(w.again.mesh.points[1] == tf::point3{0, 0, 0});
    CHECK(w.again.mesh.faces == std::vector<tf::face>{{0, 2, 3}, {1, 3, 4}});
    CHECK(column_values(w.again, "s") == numbers{0, 0.5, 1, 1, 0});
    CHECK(column_values(w.again, "t") == numbers{0, 0.5, 0, 1, 1});
    CHECK(column_values(w.again, "ny") == numbers{0, 0, 0, 0, 1});
    corners.texture_of_corner[0][0] = tf::corner_values::none;
    CHECK(through_glb(file).warnings ==
          texts{"corner-values: corners without texture coordinates got 0 0"});
    corners.texture[3][2] = 0.5;
    corners.has_w = true;
    CHECK(through_glb(file).warnings.back() ==
          "corner-values: not written to GLB: w of texture coordinates of corners");
}

TEST_CASE("glb: parts are nodes with their names and points; the same name again is one") {
    tf::mesh_file file = glb_square();
    file.mesh.points.push_back({9, 9, 9});
    file.mesh.faces = {{0, 1, 2}, {0, 2, 3}, {1, 2, 3}};
    file.stored_faces = 3;
    file.attributes.parts = {{.object = "a \xc3\xbc", .first_face = 0},
                             {.object = "a \xc3\xbc", .material = "oak", .first_face = 1},
                             {.object = "b", .group = "c\xff", .first_face = 2}};
    add_to_points<float>(file, "s", {0, 1, 2, 3, 4});
    add_to_points<float>(file, "t", {0, 0, 0, 0, 0});
    const glb_written w = through_glb(file);
    REQUIRE(w.again.attributes.parts.size() == 2);
    CHECK(w.again.attributes.parts[0].object == "a \xc3\xbc");
    CHECK(w.again.attributes.parts[1].object == "b/c\xef\xbf\xbd");
    CHECK(w.again.attributes.parts[1].first_face == 2);
    CHECK(w.again.mesh.points.size() == 7);
    CHECK(column_values(w.again, "s") == numbers{0, 1, 2, 3, 1, 2, 3});
    CHECK(w.again.mesh.faces == std::vector<tf::face>{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}});
    CHECK(w.warnings == texts{"data-dropped: 1 points without faces left out",
                              "materials: not written to GLB: materials"});
    // A name for all is that of the one node, and then all points are kept.
    file.attributes.parts.resize(1);
    CHECK(through_glb(file).again.mesh == file.mesh);
    CHECK(through_glb(file).again.attributes.parts == file.attributes.parts);
}

TEST_CASE("glb: colors of faces and numbers of faces go by parts, too") {
    tf::mesh_file file = glb_square();
    file.mesh.faces = {{0, 1, 2}, {0, 2, 3}, {1, 2, 3}, {0, 1, 3}};
    file.stored_faces = 4;
    file.attributes.parts = {{.object = "a", .first_face = 0}, {.object = "b", .first_face = 2}};
    auto& columns = file.attributes.find_or_add("face", 4).columns;
    for (const char* const name : {"red", "green", "blue"})
        columns.push_back(
            tf::column::of<std::uint8_t>(name, std::vector<std::uint8_t>{255, 0, 0, 255}));
    columns.push_back(tf::column::of<std::uint32_t>("id", std::vector<std::uint32_t>{4, 5, 6, 7}));
    const glb_written w = through_glb(file);
    CHECK(w.again.mesh.faces.size() == 4);
    CHECK(w.again.attributes.parts.size() == 2);
    CHECK(w.bytes.find(R"("materials":[{"doubleSided":true,"pbrMetallicRoughness":{)"
                       R"("baseColorFactor":[1.0,1.0,1.0,1.0])") != std::string::npos);
    CHECK(w.bytes.find(R"("material":1,"extras":{"face_properties":{"id":)") != std::string::npos);
    CHECK(w.bytes.substr(w.bytes.size() - 16) ==
          std::string("\4\0\0\0\5\0\0\0\6\0\0\0\7\0\0\0", 16));
}

TEST_CASE("glb: what it has no place for is named") {
    tf::mesh_file file = glb_square();
    add_to_points<float>(file, "quality", {1, 2, 3, 4});
    add_to_points<std::int32_t>(file, "label", {1, 2, 3, 4});
    file.attributes.find_or_add("face", 2).columns.push_back(
        tf::column::of<float>("heat", std::vector<float>{1, 2}));
    CHECK(through_glb(file).warnings ==
          texts{"columns-dropped: properties not written to GLB: quality, "
                "label, heat"});
}

TEST_CASE("glb: far from the origin, each part has the same offset") {
    tf::mesh_file file = glb_square();
    for (tf::point3& p : file.mesh.points) p = {p.x + 0x1p22, p.y / 4 - 0x1p23, p.z};
    file.attributes.parts = {{.object = "a", .first_face = 0}, {.object = "b", .first_face = 1}};
    const tf::mesh_file again = through_glb(file).again;
    CHECK(again.mesh.points[1] == file.mesh.points[1]);
    CHECK(again.mesh.points[5] == file.mesh.points[3]);
}
