#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace {

constexpr std::uint32_t none = tf::corner_values::none;

tf::mesh_file read_obj(std::string_view text, std::string_view name = "a.obj") {
    return tf::read(std::as_bytes(std::span(text)), name, {});
}

tf::corner_values corners_of(std::string_view text) { return read_obj(text).attributes.corners; }

std::string obj_complaint(std::string_view text) {
    try {
        (void)read_obj(text);
        return {};
    } catch (const tf::io_error& e) {
        return e.what();
    }
}

std::string written_mesh(const tf::mesh_file& file, const char* format, bool ascii = false) {
    return tf::write_to_memory(file, {.format = format, .ascii = ascii});
}

using faces = std::vector<tf::face>;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string rows = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nvn 0 1 0\n";

/// Two quads with a seam, a triangle of every form of corner, a row that nobody uses.
const std::string textured =
    "mtllib wood.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n"
    "vt 0 0\nvt 0.5 0\nvt 0.5 1\nvt 0 1\nvt 0.75 0.1\nvt 1 -1e-300\nvt 7 8\n"
    "vn 0 0 1\nvn 0 0.6 0.8\n"
    "usemtl oak\nf 1/1/1 2/2/1 3/3/1 4/4/1\nf 2/5/2 5/6/1 6/6/1 3/4/2\n"
    "usemtl pine\nf 1 2/2 3//2\nf 3 2 1\n";

std::string ply_of(std::string_view type, std::string_view lists) {
    return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
           "property float z\nelement face 2\nproperty int before\n"
           "property list uchar int vertex_indices\nproperty list uchar " +
           std::string(type) + " texcoord\nproperty int texnumber\nend_header\n" +
           "0 0 0\n1 0 0\n1 1 0\n0 1 0\n" + std::string(lists);
}

const std::string lists = "5 3 0 1 2 6 0 0 1 0 1 1 9\n6 4 0 2 3 1 8 0 0 1 1 0 0.5 1 0 8\n";

}  // namespace

TEST_CASE("obj: corners have the texture coordinates and normals that they name") {
    const auto all = corners_of(square + rows + "f 1/1/1 2/2/1 3/3/2\n");
    CHECK(all.texture.size() == 4);
    CHECK(all.texture[2] == std::array{1.0, 1.0, 0.0});
    CHECK_FALSE(all.has_w);
    CHECK(all.normals == std::vector<tf::point3>{{0, 0, 1}, {0, 1, 0}});
    CHECK(all.texture_of_corner == faces{{0, 1, 2}});
    CHECK(all.normal_of_corner == faces{{0, 0, 1}});
    const auto texture = corners_of(square + rows + "f 1/1 2/2 3/4\n");
    CHECK(texture.texture_of_corner == faces{{0, 1, 3}});
    CHECK(texture.normal_of_corner.empty());
    const auto normals = corners_of(square + rows + "f 1//2 2//1 3//2\n");
    CHECK(normals.texture_of_corner.empty());
    CHECK(normals.normal_of_corner == faces{{1, 0, 1}});
    CHECK(corners_of(square + rows + "f 1 2 3\n").texture_of_corner.empty());
    CHECK(corners_of(square + "vt .5 .5 .25\nf 1 2 3\n").has_w);
    CHECK(corners_of(square + "vt .5\nf 1/1 2/1 3/1\n").texture[0] == std::array{0.5, 0.0, 0.0});
}

TEST_CASE("obj: corners without a number have none, wherever the first one with a number is") {
    CHECK(corners_of(square + rows + "f 1 2 3\nf 1 2/2 3//1 4/4\nf 3 2 1\n").texture_of_corner ==
          faces{{none, none, none}, {none, 1, none}, {none, none, 3}, {none, none, none}});
    CHECK(corners_of(square + rows + "f 1 2 3\nf 1 2/2 3//1 4/4\nf 3 2 1\n").normal_of_corner ==
          faces{{none, none, none}, {none, none, 0}, {none, 0, none}, {none, none, none}});
    // The very last corner of a polygon.
    CHECK(corners_of(square + rows + "f 1 2 3 4/4\n").texture_of_corner ==
          faces{{none, none, none}, {none, none, 3}});
    // Slashes with nothing behind them, as some programs write.
    CHECK(corners_of(square + rows + "f 1/ 2/2/ 3//\n").texture_of_corner ==
          faces{{none, 1, none}});
}

TEST_CASE("obj: numbers of corners count from the end when negative, and ahead") {
    CHECK(corners_of(square + "vt 0 0\nvt 1 0\nf 1/-2 2/-1 3/-1\nvt 5 5\nf 1/-1 2/-2 3/3\n")
              .texture_of_corner == faces{{0, 1, 1}, {2, 1, 2}});
    CHECK(corners_of(square + "f 1/1/1 2/2/1 3/2/1\n" + rows).texture_of_corner ==
          faces{{0, 1, 1}});
    CHECK(corners_of(square + rows + "f 1/1 \\\n2/2 3/3\\\n\n").texture_of_corner ==
          faces{{0, 1, 2}});
}

TEST_CASE("obj: what corners name but is not there is an error of its line") {
    CHECK(obj_complaint(square + rows + "f 1/1 2/2 3/9\n") ==
          "a.obj:11: texture index '9' is out of range");
    CHECK(obj_complaint(square + rows + "f 1//1 2//2 3//3\n") ==
          "a.obj:11: normal index '3' is out of range");
    CHECK(obj_complaint(square + rows + "f 1/-5 2/1 3/1\n") ==
          "a.obj:11: texture index '-5' is out of range");
    CHECK(obj_complaint(square + rows + "f 1/0 2/1 3/1\n") ==
          "a.obj:11: texture index 0 (OBJ counts from 1)");
    CHECK(obj_complaint(square + rows + "f 1//0 2//1 3//1\n") ==
          "a.obj:11: normal index 0 (OBJ counts from 1)");
    CHECK(obj_complaint(square + rows + "f 1/x 2/1 3/1\n") ==
          "a.obj:11: expected a corner, found '1/x'");
    CHECK(obj_complaint(square + rows + "f 1/1/1/1 2/1 3/1\n") ==
          "a.obj:11: expected a corner, found '1/1/1/1'");
    CHECK(obj_complaint(square + rows + "f 1/- 2/1 3/1\n") ==
          "a.obj:11: expected a texture index, found '-'");
    CHECK(obj_complaint(square + "vt\n") ==
          "a.obj:5: expected a texture coordinate, but the line ends");
    CHECK(obj_complaint(square + "vn 0 1\n") ==
          "a.obj:5: expected a coordinate of a normal, but the line ends");
    CHECK(obj_complaint(square + "vt 0 1 2 3\n") == "a.obj:5: more than three numbers");
    CHECK(obj_complaint(square + "vt 0,5 1\n") ==
          "a.obj:5: expected a texture coordinate, found '0,5': the decimal separator must be a "
          "point");
    CHECK(obj_complaint(square + "f 1/99999999999999999999 2 3\n") ==
          "a.obj:5: texture index '99999999999999999999' is out of range");
}

TEST_CASE(
    "obj: texture coordinates and normals that are named, and of which there are none, are left "
    "out") {
    const tf::mesh_file file = read_obj(square + "f 1/1/1 2/2/1 3/3/1\n");
    CHECK(file.mesh.faces == faces{{0, 1, 2}});
    CHECK(file.attributes.corners.texture_of_corner.empty());
    CHECK(file.attributes.corners.normal_of_corner.empty());
    REQUIRE(file.warnings.size() == 2);
    CHECK(file.warnings[0].text == "corners refer to texture coordinates, but the file has none");
    CHECK(file.warnings[1].text == "corners refer to normals, but the file has none");
    // Where there is one, the rest is missing.
    CHECK(obj_complaint(square + "vt 0 0\nf 1/1 2/2 3/1\n") ==
          "a.obj:6: texture index '2' is out of range");
}

TEST_CASE("obj: a normal that is no number is no reason to refuse the mesh") {
    for (const char* const n : {"nan", "-nan(ind)", "1.#QNAN0", "-1.#IND", "inf"}) {
        CAPTURE(n);
        const auto all = corners_of(square + "vn 0 " + n + " 1\nf 1//1 2//1 3//1\n");
        CHECK_FALSE(std::isfinite(all.normals.at(0).y));
        CHECK(all.normals.at(0).z == 1.0);
    }
    CHECK(obj_complaint(square + "vn 0 x 1\n") ==
          "a.obj:5: expected a coordinate of a normal, found 'x'");
}

TEST_CASE("obj: material files are those of the lines, once each") {
    const auto names = [](std::string_view line) {
        return read_obj(square + std::string(line)).attributes.material_files;
    };
    using list = std::vector<std::string>;
    CHECK(names("mtllib a.mtl\nmtllib a.mtl\nmtllib ../b/c.mtl \n") == list{"a.mtl", "../b/c.mtl"});
    CHECK(names("mtllib a b.mtl c.MTL  d\n") == list{"a b.mtl", "c.MTL", "d"});
    CHECK(names("mtllib\nmtllib \n").empty());
}

TEST_CASE("obj: texture coordinates, normals and materials come back byte for byte") {
    CHECK(written_mesh(read_obj(textured), "obj") == textured);
    const std::string with_w = square + "vt 0 0 0.5\nf 1/1 2/1 3/1\n";
    CHECK(written_mesh(read_obj(with_w), "obj") == with_w);
    const std::string unused = square + rows + "f 1 2 3 4\n";
    CHECK(written_mesh(read_obj(unused), "obj") == unused);
}

TEST_CASE("obj: polygons that are split keep what their corners have") {
    tf::mesh_file file = read_obj(textured);
    file.split_polygons();
    const auto again = read_obj(written_mesh(file, "obj")).attributes.corners;
    CHECK(again == read_obj(textured).attributes.corners);
}

TEST_CASE("ply: texture coordinates of faces are those of corners, and come back") {
    for (const char* const type : {"float", "double"}) {
        const std::string text = ply_of(type, lists);
        const tf::mesh_file file = read_obj(text, "a.ply");
        const tf::corner_values& corners = file.attributes.corners;
        // The second face has equal values where it has a point of the first one.
        CHECK(corners.texture_of_corner == faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}});
        CHECK(corners.texture[3] == std::array{0.0, 0.5, 0.0});
        CHECK(file.attributes.find("face")->find("texcoord")->role == tf::column_role::texture);
        CHECK(written_mesh(file, "ply", true) == text);
        for (const char* const format : {"ply-ascii", "ply-binary-be", "ply-binary-le"}) {
            tf::mesh_file binary = file;
            binary.format = format;
            const tf::mesh_file again = read_obj(written_mesh(binary, "ply"), "a.ply");
            CHECK(again.attributes == file.attributes);
            CHECK(written_mesh(again, "ply", true) == text);
        }
        CHECK(corners_of(written_mesh(file, "obj")) == corners);
    }
}

TEST_CASE("ply: lists that are not two numbers a corner stay lists") {
    for (const char* const bad : {"5 3 0 1 2 6 0 0 1 0 1 1 9\n6 4 0 2 3 1 6 0 0 1 1 0 0.5 8\n",
                                  "5 3 0 1 2 3 0 0 1 9\n6 4 0 2 3 1 0 8\n",
                                  // Written again, this would be an empty list.
                                  "5 3 0 1 2 6 nan nan nan nan nan nan 9\n6 4 0 2 3 1 0 8\n",
                                  "5 3 0 1 2 6 -nan nan 1 0 1 1 9\n6 4 0 2 3 1 0 8\n"}) {
        CAPTURE(bad);
        const std::string text = ply_of("float", bad);
        const tf::mesh_file file = read_obj(text, "a.ply");
        CHECK(file.attributes.corners == tf::corner_values{});
        CHECK(written_mesh(file, "ply", true) == text);
    }
    const std::string whole =
        ply_of("uchar", lists.substr(0, lists.find('\n')) + "\n6 3 0 2 3 0 8\n");
    CHECK(read_obj(whole, "a.ply").attributes.corners == tf::corner_values{});
}

TEST_CASE("ply: a corner without texture coordinates is NaN, a face without an empty list") {
    const std::string text = ply_of("float", "5 3 0 1 2 6 0 0 nan nan 1 1 9\n6 4 0 2 3 1 0 8\n");
    const tf::mesh_file file = read_obj(text, "a.ply");
    CHECK(file.attributes.corners.texture_of_corner ==
          faces{{0, none, 1}, {none, none, none}, {none, none, none}});
    CHECK(written_mesh(file, "ply", true) == text);
    // The same of an OBJ.
    const std::string made = written_mesh(read_obj(textured), "ply", true);
    CHECK(made.find("property list uchar float texcoord\n") != std::string::npos);
    CHECK(made.find("\n4 1 4 5 2 8 0.75 0.1 1 -0 1 -0 0 1\n3 0 1 2 6 nan nan 0.5 0 nan nan\n"
                    "3 2 1 0 0\n") != std::string::npos);
}

TEST_CASE("ply: texture coordinates that the file does not have any more leave no column") {
    tf::mesh_file file = read_obj(ply_of("float", lists), "a.ply");
    file.attributes.corners = {};
    CHECK(written_mesh(file, "ply", true).find("texcoord") == std::string::npos);
    CHECK(written_mesh(file, "ply", true).find("\n5 3 0 1 2 9\n") != std::string::npos);
}

TEST_CASE("ply: what corners have is written once where a list of faces has its name") {
    const char* const bad = "5 3 0 1 2 3 0 0 1 9\n6 4 0 2 3 1 0 8\n";
    tf::mesh_file file = read_obj(ply_of("float", bad), "a.ply");
    file.attributes.corners = read_obj(ply_of("float", lists), "a.ply").attributes.corners;
    const std::string text = written_mesh(file, "ply", true);
    CHECK(text.find("texcoord") == text.rfind("texcoord"));
    CHECK(read_obj(text, "a.ply").attributes.corners == file.attributes.corners);
}

TEST_CASE("ply: texture coordinates of a polygon of 200 corners widen the length of the list") {
    std::string text = "vt 0.5 0.25\n";
    std::string face = "f";
    for (int v = 1; v <= 200; ++v) {
        text += "v " + std::to_string(v) + " " + std::to_string(v * v) + " 0\n";
        face += " " + std::to_string(v) + "/1";
    }
    const tf::mesh_file file = read_obj(text + face + "\n");
    const std::string ply = written_mesh(file, "ply");
    CHECK(ply.find("property list uint float texcoord\n") != std::string::npos);
    CHECK(ply.find("property list uchar int vertex_indices\n") != std::string::npos);
    // Each point gets a row of its own on the way back.
    CHECK(read_obj(ply, "a.ply").attributes.corners.texture.size() == 200);
}

TEST_CASE("writing: formats that do not hold what corners have say so once") {
    const auto warnings = [](std::string_view text, const char* format) {
        std::vector<std::string> codes;
        const tf::mesh_file file = read_obj(text);
        const auto path = std::filesystem::temp_directory_path() /
                          ("io_corner_values_test." + std::string(format));
        for (const auto& w : tf::write(path, file, {}).warnings)
            if (w.code == "corner-values") codes.push_back(w.text);
        std::filesystem::remove(path);
        return codes;
    };
    using list = std::vector<std::string>;
    for (const char* const format : {"stl", "off"}) CHECK(warnings(textured, format).size() == 1);
    CHECK(warnings(textured, "ply") == list{"not written to PLY: normals of corners"});
    CHECK(warnings(textured, "obj").empty());
    const std::string only_texture = square + rows + "f 1/1 2/2 3/3\n";
    CHECK(warnings(only_texture, "ply").empty());
    CHECK(warnings(only_texture, "stl") ==
          list{"not written to STL: texture coordinates of corners"});
    CHECK(warnings(square + rows + "f 1 2 3\n", "stl").empty());
    CHECK(warnings(square + "vt 0 0 0.5\nf 1/1 2/1 3/1\n", "ply") ==
          list{"not written to PLY: w of texture coordinates of corners"});
    CHECK(warnings(square + "vt 0 0 0\nf 1/1 2/1 3/1\n", "ply").empty());
}

TEST_CASE(
    "ply: names of texture files are those of its comments, and come back behind the others") {
    const auto with = [](const std::string& comments) {
        return "ply\nformat ascii 1.0\n" + comments +
               "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
               "element face 1\nproperty list uchar int vertex_indices\n"
               "end_header\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n";
    };
    using list = std::vector<std::string>;
    const tf::mesh_file file =
        read_obj(with("comment TextureFile b c.png\ncomment one\ncomment  TextureFile \t a.png \n"
                      "comment TextureFile b c.png\ncomment TextureFile\ncomment TextureFile \n"
                      "comment TextureFiles x\ncomment a TextureFile y\ncomment texturefile z\n"),
                 "a.ply");
    CHECK(file.attributes.texture_files == list{"b c.png", "a.png", "b c.png"});
    CHECK(file.attributes.comments == list{"one", "TextureFile", "TextureFile ", "TextureFiles x",
                                           "a TextureFile y", "texturefile z"});
    CHECK(written_mesh(file, "ply", true) ==
          with("comment one\ncomment TextureFile\ncomment TextureFile \ncomment TextureFiles x\n"
               "comment a TextureFile y\ncomment texturefile z\n"
               "comment TextureFile b c.png\ncomment TextureFile a.png\n"
               "comment TextureFile b c.png\n"));
    CHECK(read_obj(written_mesh(file, "ply"), "a.ply").attributes == file.attributes);
}

TEST_CASE("writing: formats that do not hold names of texture files say so") {
    tf::mesh_file file = read_obj(square + "f 1 2 3 4\n");
    file.attributes.texture_files = {"a.png"};
    for (const char* const format : {"ply", "obj", "stl", "off", "glb"}) {
        CAPTURE(format);
        const auto path = std::filesystem::temp_directory_path() /
                          ("io_corner_values_test_textures." + std::string(format));
        const auto warnings = tf::write(path, file, {}).warnings;
        std::filesystem::remove(path);
        CHECK(warnings.size() == (format == std::string("ply") ? 0 : 1));
        for (const auto& w : warnings) {
            CHECK(w.code == "materials");
            CHECK(w.text.ends_with(": names of texture files"));
        }
    }
}

TEST_CASE("writing: formats that do not hold materials say so") {
    const auto codes = [](std::string_view text, const char* format) {
        std::vector<std::string> all;
        const auto path = std::filesystem::temp_directory_path() /
                          ("io_corner_values_test_materials." + std::string(format));
        for (const auto& w : tf::write(path, read_obj(text), {}).warnings) all.push_back(w.code);
        std::filesystem::remove(path);
        return all;
    };
    const std::string face = square + "f 1 2 3 4\n";
    for (const char* const format : {"ply", "stl", "off", "glb"}) {
        CAPTURE(format);
        CHECK(codes("usemtl oak\n" + face, format) == std::vector<std::string>{"materials"});
        CHECK(codes("mtllib none.mtl\nusemtl\n" + face, format).empty());
        CHECK(codes("o oak\n" + face, format).empty());
        if (format == std::string("glb")) continue;  // which holds names
        CHECK(codes("o oak\n" + face + "o elm\nf 1 3 2\n", format) ==
              std::vector<std::string>{"data-dropped"});
    }
    CHECK(codes("usemtl oak\n" + face, "obj").empty());
}

TEST_CASE("writing: numbers of corners that are no rows are refused") {
    const tf::mesh_file good = read_obj(textured);
    const auto refuses = [&](auto&& change) {
        tf::mesh_file bad = good;
        change(bad.attributes.corners);
        CHECK_THROWS_AS(static_cast<void>(written_mesh(bad, "obj")), std::invalid_argument);
        CHECK_THROWS_AS(static_cast<void>(written_mesh(bad, "ply")), std::invalid_argument);
    };
    refuses([](tf::corner_values& c) { c.texture_of_corner.pop_back(); });
    refuses([](tf::corner_values& c) { c.normal_of_corner.push_back({0, 0, 0}); });
    refuses([](tf::corner_values& c) { c.texture_of_corner[2][1] = 7; });
    refuses([](tf::corner_values& c) { c.normals.pop_back(); });
    refuses([](tf::corner_values& c) { c.texture_of_corner[1][0] = 3; });  // no fan any more
    refuses([](tf::corner_values& c) { c.normal_of_corner[3][1] = none; });
}

TEST_CASE("stl: materials alone are no solids of their own") {
    for (const std::string& text : {textured, square + "f 1 2 3\nusemtl oak\nf 3 2 1\n"}) {
        const std::string stl = written_mesh(read_obj(text), "stl", true);
        CHECK(stl.find("endsolid") == stl.rfind("endsolid"));
    }
}

TEST_CASE("stl: faces ahead of the first name have none") {
    const tf::mesh_file file = read_obj(square + "f 1 2 3\no later\nf 1 3 4\nf 2 3 4\n");
    const auto parts = read_obj(written_mesh(file, "stl", true), "a.stl").attributes.parts;
    CHECK(parts ==
          std::vector<tf::named_faces>{{.first_face = 0}, {.object = "later", .first_face = 1}});
}

TEST_CASE("writing: no name makes lines of its own") {
    tf::mesh_file file = read_obj(square + "f 1 2 3\n");
    const std::string name = "a\nv 9 9 9\r\nf 1 2 5";
    file.attributes.parts = {{.object = name, .group = name, .material = name}};
    file.attributes.material_files = {name};
    file.attributes.texture_files = {name};
    const tf::mesh_file again = read_obj(written_mesh(file, "obj"));
    CHECK(again.mesh == file.mesh);
    const std::string flat = "a v 9 9 9  f 1 2 5";
    CHECK(again.attributes.parts == std::vector<tf::named_faces>{{flat, flat, flat}});
    CHECK(again.attributes.material_files == std::vector<std::string>{flat});
    CHECK(read_obj(written_mesh(file, "ply"), "a.ply").attributes.texture_files ==
          again.attributes.material_files);
    const auto parts = read_obj(written_mesh(file, "stl", true), "a.stl").attributes.parts;
    CHECK(parts == std::vector<tf::named_faces>{{.object = flat + "/" + flat}});
}

TEST_CASE(
    "corner values: what is appended names its own rows, and triangles without any are none") {
    const tf::corner_values a{.texture = {{0, 0, 0}, {1, 0, 0}},
                              .texture_of_corner = {{0, 1, none}}};
    const tf::corner_values b{.texture = {{2, 0, 0.5}},
                              .has_w = true,
                              .normals = {{0, 0, 1}},
                              .texture_of_corner = {{none, 0, 0}},
                              .normal_of_corner = {{0, none, 0}}};
    tf::corner_values all;
    all.append(0, {}, 1);
    CHECK(all == tf::corner_values{});
    all.append(1, a, 1);
    all.append(2, b, 1);
    all.append(3, {}, 1);
    CHECK(all.texture.size() == 3);
    CHECK(all.has_w);
    CHECK(all.texture_of_corner ==
          faces{{none, none, none}, {0, 1, none}, {none, 2, 2}, {none, none, none}});
    CHECK(all.normal_of_corner ==
          faces{{none, none, none}, {none, none, none}, {0, none, 0}, {none, none, none}});
    CHECK(all.fault(4).empty());
    CHECK(all.fault(5) == "texture coordinate numbers of 4 triangles for 5");
    all.normals.clear();
    CHECK(all.fault(4) == "a corner of triangle 2 has a normal number that is out of range");
}
