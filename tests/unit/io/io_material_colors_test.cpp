// Colors of the materials that an OBJ names, and where they go.

#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/columns.hpp>
#include <support/own_folder.hpp>

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace {

const std::string two_materials =
    "mtllib my colors.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nusemtl red one\nf 1 2 4\n"
    "usemtl blue\nf 2 3 4\nusemtl none\nf 1 3 4\n";

/// An OBJ in a folder of its own, beside a material file.
class obj_with_materials {
  public:
    explicit obj_with_materials(const std::string& materials,
                                const std::string& obj = two_materials) {
        std::ofstream(folder_.path / "my colors.mtl", std::ios::binary) << materials;
        std::ofstream(path(), std::ios::binary) << obj;
    }
    [[nodiscard]] std::filesystem::path path() const { return folder_.path / "a.obj"; }

  private:
    test::own_folder folder_{"treeform-materials"};
};

tf::mesh_file through_3mf(const tf::mesh_file& file, std::vector<tf::io_warning>& warnings) {
    const test::own_folder folder("treeform-through-3mf");
    const auto path = folder.path / "a.3mf";
    warnings = tf::write(path, file, {}).warnings;
    return tf::read(path);
}

}  // namespace

TEST_CASE("materials: faces of an OBJ have the colors that the file beside it says") {
    const obj_with_materials obj(
        "# c\nnewmtl red one \n Kd 1 0 0\nmap_Kd red.png\n\nnewmtl blue\r\nKd 0 0.502 1 # c\nd "
        "0.5\n");
    const tf::mesh_file file = tf::read(obj.path());
    CHECK(test::whole_values(file, "face", "red") == std::vector<int>{255, 255, 0, 255});
    CHECK(test::whole_values(file, "face", "green") == std::vector<int>{255, 0, 128, 255});
    CHECK(test::whole_values(file, "face", "blue") == std::vector<int>{255, 0, 255, 255});
    CHECK(test::whole_values(file, "face", "alpha") == std::vector<int>{255, 255, 128, 255});
    CHECK(file.warnings.empty());
    std::vector<tf::io_warning> warnings;
    const tf::mesh_file again = through_3mf(file, warnings);
    CHECK(warnings.empty());
    CHECK(test::whole_values(again, "face", "green") == test::whole_values(file, "face", "green"));
    CHECK(test::whole_values(again, "face", "alpha") == test::whole_values(file, "face", "alpha"));
    REQUIRE(again.attributes.parts.size() == 4);
    CHECK(again.attributes.parts[1].material == "red one");
}

TEST_CASE("materials: polygons have one color, and text on OBJ is as without material files") {
    const std::string quads =
        "mtllib my colors.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl a\nf 1 2 3 4\nf 4 3 2 "
        "1\n";
    const obj_with_materials obj("newmtl a\nKd 0 1 0\n", quads);
    const tf::mesh_file file = tf::read(obj.path());
    CHECK(file.mesh.faces.size() == 4);
    CHECK(test::whole_values(file, "face", "red") == std::vector<int>{0, 0});
    CHECK(file.attributes.find("face")->find("alpha") == nullptr);
    CHECK(tf::write_to_memory(file, {.format = "obj"}) ==
          tf::write_to_memory(tf::read(std::as_bytes(std::span(quads)), "a.obj", {}),
                              {.format = "obj"}));
}

TEST_CASE("materials: what says no color changes nothing") {
    for (const char* text :
         {"", "newmtl red\nKd 1 0 0\n", "newmtl red one\nKd\n", "newmtl red one\nKd xyz 1 0 0\n",
          "Kd 1 0 0\n", "newmtl red one\nKd nan 0 0\n", "\xff\xfe\0\x01", "newmtl"}) {
        CAPTURE(text);
        const obj_with_materials obj(text);
        const tf::mesh_file file = tf::read(obj.path());
        CHECK(file.attributes.find("face") == nullptr);
        CHECK(file.warnings.empty());
    }
}

TEST_CASE("materials: Kd of one number is gray, and is kept between 0 and 1; Tr is not guessed") {
    const obj_with_materials obj("newmtl red one\nKd 0.2\nTr 0.5\nnewmtl blue\nKd -1 2 0.5 7\n");
    const tf::mesh_file file = tf::read(obj.path());
    CHECK(test::whole_values(file, "face", "red") == std::vector<int>{255, 51, 0, 255});
    CHECK(test::whole_values(file, "face", "green") == std::vector<int>{255, 51, 255, 255});
    CHECK(test::whole_values(file, "face", "blue") == std::vector<int>{255, 51, 128, 255});
    REQUIRE(file.warnings.size() == 1);
    CHECK(file.warnings[0].text.find("Tr") != std::string::npos);
}

TEST_CASE("materials: 3MF says where it knows no colors, and which it leaves out") {
    std::vector<tf::io_warning> warnings;
    (void)through_3mf(tf::read(std::as_bytes(std::span(two_materials)), "a.obj", {}), warnings);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].text.find("my colors.mtl") != std::string::npos);

    const obj_with_materials obj(
        "newmtl m\nKd 1 0 0\n",
        "mtllib my colors.mtl\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nusemtl m\nf 1 2 3\n");
    CHECK(test::whole_values(through_3mf(tf::read(obj.path()), warnings), "face", "red") ==
          std::vector<int>{255});
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].code == "colors-dropped");
}
