/// \file
/// Files of sections, byte for byte.

#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/section.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/own_folder.hpp>
#include <support/solids.hpp>

#include <array>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace {

std::string written(const tf::section_result& section, const std::string& name,
                    const std::string& format = {}) {
    const test::own_folder folder("write_section");
    const std::filesystem::path path = folder.path / name;
    tf::write_section(path, section, format);
    return test::bytes_of(path);
}

/// A tetrahedron, cut at half its height, and the same without a face.
tf::section_result cut_tetrahedron(bool open) {
    tf::mesh mesh{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}},
                  {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    if (open) mesh.faces.pop_back();
    return tf::section(mesh, {}, std::array{1.0, 3.0});
}

}  // namespace

TEST_CASE("sections are written as SVG, DXF, OBJ and JSON") {
    const tf::section_result closed = cut_tetrahedron(false);
    CHECK(written(closed, "a.svg") ==
          "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-0.001 -1.001 1.002 1.002\" "
          "stroke=\"black\" "
          "stroke-width=\"0.001\" fill-rule=\"evenodd\">\n"
          "<g id=\"layer0\" data-height=\"1\">\n"
          "<path fill=\"silver\" d=\"M0 0L1 0L0 -1Z\"/>\n</g>\n"
          "<g id=\"layer1\" data-height=\"3\">\n</g>\n</svg>\n");
    CHECK(written(closed, "a.obj") == "v 0 0 1\nv 1 0 1\nv 0 1 1\no layer0\nl 1 2 3 1\no layer1\n");
    CHECK(written(closed, "a.txt", "json") ==
          "{\"x\":[1,0,0],\"y\":[0,1,0],\"normal\":[0,0,1],\"layers\":[\n"
          "{\"at\":[0,0,1],\"height\":1,\"area\":0.5,\"length\":3.414213562373095,\"open\":0,"
          "\"loops\":[\n"
          "{\"closed\":true,\"oriented\":true,\"parent\":null,\"depth\":0,\"area\":0.5,"
          "\"length\":3.414213562373095,\"points\":[[0,0],[1,0],[0,1]]}]},\n"
          "{\"at\":[0,0,3],\"height\":3,\"area\":0,\"length\":0,\"open\":0,\"loops\":[]}]}\n");
    const std::string dxf = written(closed, "a.DXF");
    CHECK(
        dxf.starts_with("0\nSECTION\n2\nENTITIES\n0\nPOLYLINE\n8\nLAYER0\n66\n1\n70\n9\n10\n0\n"));
    CHECK(dxf.find("0\nVERTEX\n8\nLAYER0\n10\n1\n20\n0\n30\n1\n70\n32\n") != std::string::npos);
    CHECK(dxf.ends_with("0\nSEQEND\n8\nLAYER0\n0\nENDSEC\n0\nEOF\n"));
}

TEST_CASE("a unit gives SVG its size on paper, and DXF its header") {
    const test::own_folder folder("section_units");
    const auto in_unit = [&](const std::string& name, const std::string& unit) {
        tf::write_section(folder.path / name, cut_tetrahedron(false), {}, unit);
        return test::bytes_of(folder.path / name);
    };
    CHECK(in_unit("a.svg", "cm").find(" width=\"10.02mm\" height=\"10.02mm\" viewBox") !=
          std::string::npos);
    CHECK(in_unit("a.dxf", "in")
              .starts_with("0\nSECTION\n2\nHEADER\n9\n$"
                           "INSUNITS\n70\n1\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"));
    CHECK(in_unit("a.json", "um").starts_with("{\"unit\":\"um\",\"x\":"));
    CHECK_THROWS_AS(in_unit("b.svg", "yard"), std::invalid_argument);
    CHECK(!std::filesystem::exists(folder.path / "b.svg"));
}

TEST_CASE("isolines are written in space, and seen from a side as SVG") {
    const test::own_folder folder("write_isolines");
    const tf::mesh sheet{{{0, 0, 0}, {2, 0, 0}, {0, 0, 2}}, {{0, 1, 2}}};
    const tf::isolines_result lines =
        tf::isolines(sheet, std::array{0.0, 2.0, 2.0}, std::array{1.0, 1.5, 9.0});
    const auto as = [&](const std::string& name, const tf::oriented_plane& seen) {
        tf::write_isolines(folder.path / name, lines, seen);
        return test::bytes_of(folder.path / name);
    };
    CHECK(as("a.obj", {}) ==
          "v 0 0 1\nv 1 0 0\nv 0 0 1.5\nv 1.5 0 0\no level0\nl 1 2\no level1\nl 3 4\n");
    CHECK(as("a.json", {})
              .starts_with("{\"lines\":[\n{\"level\":1,\"closed\":false,\"oriented\":true,"
                           "\"length\":1.414213562"));
    CHECK(as("a.dxf", {}).find("0\nVERTEX\n8\nLEVEL1\n10\n0\n20\n0\n30\n1.5\n70\n32\n") !=
          std::string::npos);
    const tf::oriented_plane across{{}, {0, 1, 0}};  // axes z, x
    CHECK(as("a.svg", across)
              .find("<g id=\"level1\" data-level=\"1.5\">\n"
                    "<path fill=\"none\" d=\"M1.5 0L0 -1.5\"/>") != std::string::npos);
}

TEST_CASE("open polylines are not filled and not closed") {
    const tf::section_result open = cut_tetrahedron(true);
    CHECK(written(open, "a.svg").find("<path fill=\"none\" d=\"M0 0L1 0L0 -1\"/>") !=
          std::string::npos);
    CHECK(written(open, "a.obj").find("\nl 1 2 3\n") != std::string::npos);
    CHECK(written(open, "a.dxf").find("\n66\n1\n70\n8\n") != std::string::npos);
    CHECK(written(open, "a.json").find("\"open\":1") != std::string::npos);
}

TEST_CASE("another format is refused, and leaves no file") {
    const test::own_folder folder("write_section");
    CHECK_THROWS_AS(tf::write_section(folder.path / "a.stl", {}), tf::io_error);
    CHECK(std::filesystem::is_empty(folder.path));
    CHECK(written({}, "a.svg").find("viewBox=\"0 0 0 0\"") != std::string::npos);
}
