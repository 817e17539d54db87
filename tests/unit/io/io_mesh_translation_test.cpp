// What meshes keep between formats, and what is said of the rest.

#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/write.hpp>

#include <doctest/doctest.h>
#include <support/translated.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tf = treeform;

namespace {

using test::add_translated;
using test::is_named_in;
using test::put_translated;
using test::read_translated;
using test::sentences;
using test::translated_column;
using test::translated_file;
using test::translated_numbers;

const sentences mesh_formats{"ply", "obj", "off", "stl", "glb", "3mf"};

/// Two faces that a file may not merge into one, in coordinates that float32 holds.
tf::mesh_file folded_sheet() {
    tf::mesh_file file;
    file.mesh.points = {{0, 0, 0}, {1, 0.25, 0}, {2, 0, 4.5}, {0.5, 3, 1}};
    file.mesh.faces = {{0, 1, 2}, {2, 1, 3}};
    file.stored_faces = 2;
    return file;
}

tf::mesh_file sheet_with_looks() {
    tf::mesh_file file = folded_sheet();
    add_translated<std::uint8_t>(file, "red", {255, 64, 1, 9});
    add_translated<std::uint8_t>(file, "green", {128, 0, 2, 90});
    add_translated<std::uint8_t>(file, "blue", {0, 255, 3, 200});
    add_translated<float>(file, "nx", {0, 0, 1, 0});
    add_translated<float>(file, "ny", {0, 1, 0, 0});
    add_translated<float>(file, "nz", {1, 0, 0, -1});
    add_translated<float>(file, "s", {0, 0.5, 1, 0.25});
    add_translated<float>(file, "t", {0.25, 0.75, 0, 1});
    return file;
}

/// Positions of the corners of all faces.
std::vector<tf::point3> corner_points(const tf::mesh_file& file) {
    std::vector<tf::point3> all;
    for (const tf::face& f : file.mesh.faces)
        for (const std::uint32_t corner : f) all.push_back(file.mesh.points[corner]);
    return all;
}

/// The same of a column of points, or of what corners have of its kind; empty where there is none.
std::vector<double> corner_numbers(const tf::mesh_file& file, const std::string& name) {
    const std::vector<double> values = translated_numbers(file, name);
    const tf::corner_values& own = file.attributes.corners;
    std::vector<double> all;
    for (std::size_t f = 0; f < file.mesh.faces.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            if (!values.empty())
                all.push_back(values[file.mesh.faces[f][k]]);
            else if (name[0] == 'n' && !own.normal_of_corner.empty())
                all.push_back(own.normals[own.normal_of_corner[f][k]]
                                         [static_cast<std::size_t>(name[1] - 'x')]);
            else if ((name == "s" || name == "t") && !own.texture_of_corner.empty())
                all.push_back(own.texture[own.texture_of_corner[f][k]][name == "s" ? 0 : 1]);
        }
    return all;
}

std::vector<double> face_numbers(const tf::mesh_file& file, const std::string& name) {
    std::vector<double> values;
    const tf::element* const e = file.attributes.find("face");
    if (const tf::column* const c = e == nullptr ? nullptr : e->find(name))
        for (std::size_t i = 0; i < c->size(); ++i) values.push_back(c->number(i));
    return values;
}

struct twice_translated {
    tf::mesh_file end{};
    sentences said{};
};

twice_translated through(const tf::mesh_file& given, const std::string& first,
                         const std::string& second) {
    twice_translated made;
    const translated_file one = put_translated(given, first);
    const tf::mesh_file there = read_translated(one.bytes, first);
    const translated_file two = put_translated(there, second);
    made.end = read_translated(two.bytes, second);
    made.said = one.warnings;
    made.said.insert(made.said.end(), two.warnings.begin(), two.warnings.end());
    for (const tf::mesh_file* file : {&there, static_cast<const tf::mesh_file*>(&made.end)})
        for (const tf::io_warning& w : file->warnings) made.said.push_back(w.text);
    return made;
}

}  // namespace

TEST_CASE(
    "mesh translation: over all pairs of formats, looks of points stay or are named as lost") {
    const tf::mesh_file given = sheet_with_looks();
    for (const std::string& first : mesh_formats)
        for (const std::string& second : mesh_formats) {
            CAPTURE(first);
            CAPTURE(second);
            const auto [end, said] = through(given, first, second);
            CHECK(corner_points(end) == corner_points(given));
            for (const char* name : {"red", "green", "blue", "nx", "ny", "nz", "s", "t"}) {
                CAPTURE(name);
                const std::vector<double> expected = corner_numbers(given, name);
                std::vector<double> values = corner_numbers(end, name);
                const bool is_color = name == std::string("red") || name == std::string("green") ||
                                      name == std::string("blue");
                const tf::column* const c = translated_column(end, name);
                if (is_color && c != nullptr && c->type >= tf::scalar_type::float32)  // shares of 1
                    for (double& value : values) value *= 255.0;
                const bool is_lost =
                    is_named_in(said, name) || (!is_color && is_named_in(said, "normals of")) ||
                    (!is_color && is_named_in(said, "texture coordinates of corners"));
                if (is_lost) continue;
                REQUIRE(values.size() == expected.size());
                for (std::size_t i = 0; i < values.size(); ++i)
                    CHECK(values[i] == doctest::Approx(expected[i]));
            }
        }
}

TEST_CASE(
    "mesh translation: over all pairs of formats, colors of faces stay or are named as lost") {
    for (const std::string prefix : {"", "diffuse_"}) {
        tf::mesh_file given = folded_sheet();
        auto& columns = given.attributes.find_or_add("face", 2).columns;
        const std::vector<std::uint8_t> red{10, 255}, green{20, 0}, blue{30, 128};
        columns.push_back(tf::column::of<std::uint8_t>(prefix + "red", red));
        columns.push_back(tf::column::of<std::uint8_t>(prefix + "green", green));
        columns.push_back(tf::column::of<std::uint8_t>(prefix + "blue", blue));
        for (const std::string& first : mesh_formats)
            for (const std::string& second : mesh_formats) {
                CAPTURE(prefix);
                CAPTURE(first);
                CAPTURE(second);
                const auto [end, said] = through(given, first, second);
                CHECK(corner_points(end) == corner_points(given));
                if (is_named_in(said, "red") || is_named_in(said, prefix + "red") ||
                    is_named_in(said, "colors"))
                    continue;
                const bool keeps_names = first == "ply" && second == "ply";
                CHECK(face_numbers(end, (keeps_names ? prefix : "") + "red") ==
                      std::vector<double>{10, 255});
                CHECK(face_numbers(end, (keeps_names ? prefix : "") + "blue") ==
                      std::vector<double>{30, 128});
            }
    }
}

TEST_CASE(
    "mesh translation: diffuse colors of points are colors, and what is dropped is not written") {
    tf::mesh_file given = folded_sheet();
    given.format = "ply-ascii";
    add_translated<std::uint8_t>(given, "diffuse_red", {255, 64, 1, 9});
    add_translated<std::uint8_t>(given, "diffuse_green", {128, 0, 2, 90});
    add_translated<std::uint8_t>(given, "diffuse_blue", {0, 255, 3, 200});
    for (const std::string format : {"off", "glb", "3mf"}) {
        CAPTURE(format);
        const translated_file made = put_translated(given, format);
        CHECK(made.warnings.empty());
        CHECK(corner_numbers(read_translated(made.bytes, format), "green") ==
              corner_numbers(given, "diffuse_green"));
        const translated_file less = put_translated(given, format, {.drop = {"diffuse_blue"}});
        CHECK(corner_numbers(read_translated(less.bytes, format), "red").empty());
    }
}

TEST_CASE("mesh translation: STL says how many points it leaves out") {
    tf::mesh_file given = folded_sheet();
    given.mesh.points.push_back({7, 7, 7});
    for (const bool ascii : {false, true})
        CHECK(put_translated(given, "stl", {.ascii = ascii}).warnings ==
              sentences{"data-dropped: 1 point without faces left out: STL holds faces only"});
    for (const std::string& format : mesh_formats)
        if (format != "stl") CHECK(put_translated(given, format).warnings.empty());
}

TEST_CASE("mesh translation: STL as text says that attributes of faces are left out") {
    tf::mesh_file given = folded_sheet();
    given.attributes.find_or_add("face", 2).columns.push_back(
        tf::column::of<std::uint16_t>("stl_attribute", std::vector<std::uint16_t>{7, 8}));
    CHECK(put_translated(given, "stl").warnings.empty());
    CHECK(is_named_in(put_translated(given, "stl", {.ascii = true}).warnings, "stl_attribute"));
}

TEST_CASE(
    "mesh translation: OFF: normals that are not negative, and colors beside texture coordinates") {
    const std::string normals = "0.6 0.8 0\n";
    const tf::mesh_file shaded = read_translated(
        "NOFF\n3 1 0\n0 0 0 " + normals + "1 0 0 " + normals + "0 1 0 " + normals + "3 0 1 2\n",
        "off");
    CHECK(translated_numbers(shaded, "nx") == std::vector<double>{0.6, 0.6, 0.6});
    CHECK(translated_numbers(shaded, "nz") == std::vector<double>{0, 0, 0});
    const tf::mesh_file textured = read_translated(
        "STCOFF\n3 1 0\n0 0 0 255 0 9 0.5 1\n1 0 0 0 64 9 0.5 0\n0 1 0 1 2 3 0.5 0\n3 0 1 2\n",
        "off");
    REQUIRE(translated_column(textured, "red") != nullptr);
    CHECK(translated_column(textured, "red")->type == tf::scalar_type::uint8);
    CHECK(translated_numbers(textured, "s") == std::vector<double>{0.5, 0.5, 0.5});
    CHECK(translated_numbers(textured, "t") == std::vector<double>{1, 0, 0});
}

TEST_CASE("mesh translation: GLB: colors of faces are those of materials, to the byte") {
    tf::mesh_file given = folded_sheet();
    CHECK(face_numbers(test::passed_through(given, "glb"), "red").empty());
    given.mesh.faces.clear();
    std::vector<std::uint8_t> ramp;
    for (unsigned value = 0; value < 256; ++value) {
        given.mesh.faces.push_back({0, 1, 2});
        ramp.push_back(static_cast<std::uint8_t>(value));
    }
    given.stored_faces = 256;
    auto& columns = given.attributes.find_or_add("face", 256).columns;
    for (const char* name : {"red", "green", "blue", "alpha"})
        columns.push_back(tf::column::of<std::uint8_t>(name, ramp));
    const tf::mesh_file back = test::passed_through(given, "glb");
    CHECK(back.warnings.empty());
    for (const char* name : {"red", "green", "blue", "alpha"})
        CHECK(face_numbers(back, name) == std::vector<double>(ramp.begin(), ramp.end()));
    for (tf::column& c : columns) c = tf::column::of<float>(c.name, std::vector<float>(256, 0.7F));
    const tf::mesh_file rounded = test::passed_through(given, "glb");
    REQUIRE(rounded.warnings.size() == 1);
    CHECK(rounded.warnings[0].text == "colors of materials are rounded to 8 bits");
    CHECK(face_numbers(rounded, "red") == std::vector<double>(256, 179.0));
}

TEST_CASE("mesh translation: colors of points of more than 8 bits, and of floats beyond 1") {
    for (const char* format : {"glb", "3mf"}) {
        CAPTURE(format);
        tf::mesh_file deep = folded_sheet();
        deep.format = "ply-ascii";
        tf::mesh_file large = deep;
        tf::mesh_file fine = deep;
        for (const char* name : {"red", "green", "blue"}) {
            add_translated<std::uint16_t>(deep, name, {65535, 256, 0, 40000});
            add_translated<float>(large, name, {255, 64, 0, 7});
            add_translated<float>(fine, name, {1, 0.3F, 0, 0.5F});
        }
        const bool is_glb = format == std::string("glb");
        const translated_file of_deep = put_translated(deep, format);
        CHECK(is_named_in(of_deep.warnings, "colors") == !is_glb);
        CHECK(translated_numbers(read_translated(of_deep.bytes, format), "red")[0] ==
              (is_glb ? 65535 : 255));
        const translated_file of_large = put_translated(large, format);
        CHECK(is_named_in(of_large.warnings, "colors"));
        CHECK(corner_numbers(read_translated(of_large.bytes, format), "red") ==
              corner_numbers(large, "red"));
        CHECK(is_named_in(put_translated(fine, format).warnings, "colors") == !is_glb);
    }
}

TEST_CASE("mesh translation: 3MF says that names are lost where parts share points") {
    tf::mesh_file given = folded_sheet();
    given.attributes.parts = {{.object = "left", .first_face = 0},
                              {.object = "right", .first_face = 1}};
    CHECK(
        put_translated(given, "3mf").warnings ==
        sentences{
            "data-dropped: names of parts left out, since parts that share points are one object"});
    given.mesh.points.insert(given.mesh.points.end(), {{2, 0, 4.5}, {1, 0.25, 0}});
    given.mesh.faces[1] = {4, 5, 3};
    CHECK(put_translated(given, "3mf").warnings.empty());
}

TEST_CASE("mesh translation: OFF: a comment may begin right behind a number") {
    const tf::mesh_file file = read_translated(
        "COFF\n3 1 0#counts\n0 0 0 1 0 0#red\n1 0 0 0 1 0 # green\n0 1 0 0 0 1\n3 0 1 2#face\n",
        "off");
    CHECK(file.mesh.faces.size() == 1);
    CHECK(translated_numbers(file, "green") == std::vector<double>{0, 1, 0});
    CHECK_THROWS_AS((void)read_translated("OFF\n1 0 0\n1.#IND 0 0\n", "off"), tf::io_error);
}

TEST_CASE("mesh translation: 3MF keeps the unit of all remarks, and says so") {
    tf::mesh_file given = folded_sheet();
    given.attributes.obj_info = {"unit inch"};
    CHECK(put_translated(given, "3mf").warnings.empty());
    given.attributes.obj_info.emplace_back("made by hand");
    CHECK(put_translated(given, "3mf").warnings ==
          sentences{"data-dropped: not written to 3MF: remarks"});
}

TEST_CASE("mesh translation: faces ahead of a part that has a name; groups are names in STL") {
    tf::mesh_file given = folded_sheet();
    given.attributes.parts = {{.object = "lid", .group = "inner", .first_face = 1}};
    for (const char* format : {"ply", "off", "stl", "3mf"})
        CHECK(is_named_in(put_translated(given, format).warnings, "names of parts"));
    const translated_file text = put_translated(given, "stl", {.ascii = true});
    CHECK(text.warnings.empty());
    CHECK(text.bytes.find("\nsolid lid/inner\n") != std::string::npos);
    given.attributes.parts[0].object.clear();
    CHECK(put_translated(given, "stl", {.ascii = true}).bytes.find("\nsolid inner\n") !=
          std::string::npos);
}
