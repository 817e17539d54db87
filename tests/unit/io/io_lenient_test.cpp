// Files that are not as their format says, and are read all the same: what comes of them, what is
// said, and where it ends.

#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace {

tf::mesh_file read_named(std::string_view bytes, std::string_view name) {
    return tf::read(std::as_bytes(std::span(bytes)), name, {});
}

/// "code: text" of each warning, a line each.
std::string warnings(const tf::mesh_file& file) {
    std::string all;
    for (const tf::io_warning& w : file.warnings) all += w.code + ": " + w.text + "\n";
    return all;
}

/// What is said of bytes that are refused; nothing when they are read.
std::string named_refusal(std::string_view bytes, std::string_view name) {
    try {
        (void)read_named(bytes, name);
        return {};
    } catch (const tf::io_error& e) {
        return e.what();
    }
}

/// Triangles in planes z = 0, 1, ..., with `stated` as their count.
std::string binary_stl(std::uint32_t stated, std::size_t facets, std::size_t behind = 0) {
    std::string bytes(80, ' ');
    const auto put = [&bytes](auto value) {
        for (std::size_t i = 0; i < sizeof value; ++i)
            bytes += static_cast<char>(std::bit_cast<std::array<char, sizeof value>>(value)[i]);
    };
    put(stated);
    for (std::size_t f = 0; f < facets; ++f) {
        const auto z = static_cast<float>(f);
        for (const float x : {0.F, 0.F, 1.F, 0.F, 0.F, z, 1.F, 0.F, z, 0.F, 1.F, z}) put(x);
        put(std::uint16_t{0});
    }
    return bytes + std::string(behind, 'x');
}

const std::string facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

std::string replaced(std::string text, std::string_view what, std::string_view by) {
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    return text.replace(at, what.size(), by);
}

const std::string corners =
    "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n";
const std::string five_points = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n";

std::string strips(const std::string& rows, int count = 1) {
    return "ply\nformat ascii 1.0\n" + corners + "element tristrips " + std::to_string(count) +
           "\nproperty list int int vertex_indices\nend_header\n" + five_points + rows;
}

}  // namespace

TEST_CASE("stl binary: bytes behind the triangles of the header are left out") {
    const tf::mesh_file whole = read_named(binary_stl(2, 2), "a.stl");
    CHECK(whole.warnings.empty());
    for (const std::size_t behind : {1U, 49U, 51U, 4000U - 1U}) {
        const tf::mesh_file file = read_named(binary_stl(2, 2, behind), "a.stl");
        CHECK(file.mesh.points == whole.mesh.points);
        CHECK(file.mesh.faces == whole.mesh.faces);
        CHECK(warnings(file) == "trailing-bytes: " + std::to_string(behind) +
                                    (behind == 1 ? " byte" : " bytes") +
                                    " after the 2 triangles of the header not read\n");
    }
}

TEST_CASE("stl binary: a size of whole triangles is believed more than the header") {
    for (const std::uint32_t stated : {0U, 2U, 4U, 4294967295U}) {
        const tf::mesh_file file = read_named(binary_stl(stated, 3), "a.stl");
        CHECK(file.mesh.faces == std::vector<tf::face>{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}});
        CHECK(file.mesh.points == read_named(binary_stl(3, 3), "a.stl").mesh.points);
        CHECK(file.stored_faces == 3);
        CHECK(warnings(file) == "wrong-count: the header announces " + std::to_string(stated) +
                                    " triangles, the file has 3; these were read\n");
    }
}

TEST_CASE("stl binary: a file that ends within a triangle is refused, and so is any other text") {
    for (std::size_t lost = 1; lost < 50; ++lost) {
        const std::string whole = binary_stl(3, 3);
        CHECK(named_refusal(whole.substr(0, whole.size() - lost), "a.stl") ==
              "a.stl: byte 80: the header announces 3 triangles, the file has 2: damaged or "
              "truncated");
    }
    CHECK(named_refusal(binary_stl(3, 0), "a.stl") ==
          "a.stl: byte 80: the header announces 3 triangles, the file has 0: damaged or truncated");
    CHECK(named_refusal(binary_stl(0, 0, 75), "a.stl") ==
          "a.stl: byte 80: the header announces 0 triangles, the file has 1: damaged or truncated");
    CHECK(read_named(binary_stl(0, 0), "a.stl").mesh.faces.empty());
    // Of the size of one triangle.
    CHECK(named_refusal("<html>" + std::string(84 + 50 - 6, 'a'), "a.stl") ==
          "a.stl: neither a binary STL nor text that starts with 'solid'");
    std::string wide = "\xff\xfe";
    for (const char c : "solid\nendsolid\n" + std::string(50, ' ')) wide += {c, '\0'};
    CHECK(named_refusal(wide, "a.stl") ==
          "a.stl: byte 0: UTF-16 text; convert it to UTF-8 or ASCII");
}

TEST_CASE("stl text: words after endloop and endfacet are left out") {
    const tf::mesh_file whole = read_named("solid\n" + facet + facet + "endsolid\n", "a.stl");
    CHECK(whole.warnings.empty());
    const std::string odd =
        replaced(replaced(facet, "endloop", "endloop 3 edges"), "endfacet", "ENDFACET facets 2");
    const tf::mesh_file file = read_named("solid\n" + facet + odd + "endsolid\n", "a.stl");
    CHECK(file.mesh.points == whole.mesh.points);
    CHECK(file.mesh.faces == whole.mesh.faces);
    CHECK(warnings(file) ==
          "stray-words: 4 words after 'endloop' or 'endfacet' ignored, the first in line 14\n");
    std::string flat = facet + replaced(facet, "endloop", "endloop x");
    for (char& c : flat) c = c == '\n' ? ' ' : c;
    const tf::mesh_file line = read_named("solid\n" + flat + "endsolid", "a.stl");
    CHECK(line.mesh.points == whole.mesh.points);
    CHECK(warnings(line) ==
          "stray-words: 1 word after 'endloop' or 'endfacet' ignored, the first in line 2\n");
    CHECK(named_refusal("solid\n" + replaced(facet, "endloop", "endloop\n3") + "endsolid",
                        "a.stl") == "a.stl:8: expected 'endfacet', found '3'");
}

TEST_CASE("stl text: zero bytes between words are blanks, in and beside numbers they are refused") {
    using namespace std::string_literals;
    const tf::mesh_file whole = read_named("solid a\n" + facet + facet + "endsolid\n", "a.stl");
    const std::string odd = replaced(replaced(facet, "endloop\n", "endloop\0\n\0"s),
                                     "vertex 1 0 0\n", "vertex 1 0 0 \0\n"s);
    const tf::mesh_file file = read_named(
        "solid a\0bc\0\n"s + facet + odd + "endsolid\n"s + std::string(512, '\0'), "a.stl");
    CHECK(file.format == "stl-ascii");
    CHECK(file.mesh.points == whole.mesh.points);
    CHECK(file.attributes.parts == whole.attributes.parts);
    CHECK(warnings(file) == "zero-bytes: 517 zero bytes between words read as blanks\n");
    for (const std::string& line : {"vertex 1\0 0 0\n"s, "vertex 1 0 0\0\n"s, "vertex 1 \0 0 0\n"s,
                                    "vertex 1 0\0000 0\n"s, "vertex\0 1 0 0\n"s}) {
        const std::string text =
            "solid\n" + facet + replaced(facet, "vertex 1 0 0\n", line) + "endsolid\n";
        CHECK(named_refusal(text, "a.stl").starts_with("a.stl:12: "));
    }
}

TEST_CASE("hexadecimal numbers are read where decimal ones are") {
    const std::string said = "hexadecimal: the file has hexadecimal numbers, such as 0x1.8p1\n";
    const tf::point3 p{3.0, -0.1, 0x1p-1074};
    const std::string text = "0x1.8p1 -0x1.999999999999ap-4 0X0.0000000000001P-1022";
    const auto check = [&](const tf::mesh_file& file) {
        CHECK(file.mesh.points.back() == p);
        CHECK(warnings(file) == said);
    };
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\n"
        "property double z\nproperty uchar q\nend_header\n";
    check(read_named("v " + text + "\n", "a.obj"));
    check(read_named("OFF\n1 0 0\n" + text + "\n", "a.off"));
    check(read_named(ply + text + " 1\n", "a.ply"));
    check(read_named("1 2 3\n" + text + "\n", "a.xyz"));
    check(read_named("x,y,z\n1,2,3\n0x1.8p1,-0x1.999999999999ap-4,0x0.0000000000001p-1022\n",
                     "a.csv"));
    check(read_named(
        "VERSION .7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\n"
        "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1\nDATA ascii\n" +
            text + "\n",
        "a.pcd"));
    check(read_named("solid\n" + replaced(facet, "0 1 0", text) + "endsolid\n", "a.stl"));
    const tf::mesh_file small = read_named(ply + "1 2 3 0xff\n", "a.ply");
    CHECK(warnings(small) == said);
    CHECK(small.attributes.elements[0].columns[3].number(0) == 255.0);

    CHECK(read_named("v 0 1 2 # 0x1\n", "a.obj").warnings.empty());
    for (const char* const wrong : {"0x", "0xg", "0x1.8p", "0x-1", "0xnan", "0x1p5000", "00x1"})
        CHECK(named_refusal("v 1 2 " + std::string(wrong) + "\n", "a.obj") ==
              "a.obj:1: expected a coordinate, found '" + std::string(wrong) + "'");
}

TEST_CASE("ply: strips are triangles in turn, and start anew at -1") {
    const std::string said = "triangle-strips: the faces were read from triangle strips\n";
    const std::vector<tf::face> wanted{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {1, 3, 2}};
    const tf::mesh_file file = read_named(strips("9 0 1 2 3 4 -1 1 3 2\n"), "a.ply");
    CHECK(file.mesh.faces == wanted);
    CHECK(file.stored_faces == 4);
    CHECK(file.face_of_triangle.empty());
    CHECK(warnings(file) == said);
    CHECK(read_named(strips("5 0 1 2 3 4\n4 1 3 2 -1\n", 2), "a.ply").mesh.faces == wanted);
    // A strip of one or two vertices has no triangle.
    CHECK(read_named(strips("14 -1 4 -1 0 1 2 3 4 -1 1 3 2 -1 0\n"), "a.ply").mesh.faces == wanted);
    // Repeated vertices join strips; what they make has no area, and keeps its number.
    CHECK(read_named(strips("7 0 1 2 2 1 1 3\n"), "a.ply").mesh.faces ==
          std::vector<tf::face>{{0, 1, 2}, {2, 1, 2}, {2, 2, 1}, {1, 2, 1}, {1, 1, 3}});
    // Written, they are faces.
    const std::string again = tf::write_to_memory(file, {.format = "ply", .ascii = true});
    CHECK(again.find("tristrips") == std::string::npos);
    CHECK(read_named(again, "a.ply").mesh.faces == wanted);
    CHECK(read_named(again, "a.ply").warnings.empty());
}

TEST_CASE("ply: strips in bytes, and those that cannot be read") {
    std::string bytes =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty char x\nproperty char y\n"
        "property char z\nelement tristrips 1\nproperty list uint char vertex_index\nend_header\n";
    bytes += std::string("\0\0\0\1\0\0\0\1\0", 9) + std::string("\4\0\0\0\0\1\2\xff", 8);
    CHECK(read_named(bytes, "a.ply").mesh.faces == std::vector<tf::face>{{0, 1, 2}});
    bytes[bytes.size() - 5] = '\x7f';  // of the length
    CHECK(named_refusal(bytes, "a.ply").find("a list of 2130706436 values") != std::string::npos);
    CHECK(named_refusal(strips("3 0 1 5\n"), "a.ply").find("vertex index 5 is out of range") !=
          std::string::npos);
    CHECK(named_refusal(strips("3 0 1 -2\n"), "a.ply").find("vertex index -2 is out of range") !=
          std::string::npos);
    CHECK(named_refusal("ply\nformat ascii 1.0\n" + corners +
                            "element tristrips 1\nproperty int n\nend_header\n" + five_points +
                            "1\n",
                        "a.ply") == "a.ply: element 'tristrips' has no list of vertex_indices");
    CHECK(named_refusal(replaced(strips("3 0 1 2\n3 0 1 2\n"), "element tristrips",
                                 "element face 1\nproperty list int int vertex_indices\nelement "
                                 "tristrips"),
                        "a.ply") ==
          "a.ply: a file with both faces and triangle strips is not supported");
}

TEST_CASE("lenient: numbers of OBJ vertices that are neither coordinates nor a color are counted") {
    const auto said = [](const std::string& more) {
        return warnings(read_named("v 0 0 0\nv 1 0 0" + more + "\nv 0 1 0\nf 1 2 3\n", "a.obj"));
    };
    CHECK(said("").empty());
    CHECK(said(" 1").empty());  // the usual weight
    const std::string one =
        "skipped-numbers: 1 vertices have more numbers, such as weights, which were not read\n";
    CHECK(said(" 2") == one);
    CHECK(said(" 1 1") == one);
    CHECK(said(" 0.5 0.5 0.5").find("skipped-numbers") == std::string::npos);
    CHECK(said(" 0.5 0.5 0.5 1").find(one) != std::string::npos);
}

TEST_CASE("lenient: fields of PCD that are said to have no values take no room") {
    const std::string header =
        "VERSION 0.7\nFIELDS x y z _ t _\nSIZE 4 4 4 2 1 1\nTYPE F F F U U U\nCOUNT 1 1 1 0 1 3\n"
        "WIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA binary\n";
    std::string rows(32, '\0');
    rows[12] = 7;
    rows[28] = 8;
    const tf::mesh_file file = read_named(header + rows, "a.pcd");
    const tf::column* const t = file.attributes.elements.at(0).find("t");
    REQUIRE(t != nullptr);
    CHECK(t->number(0) == 7);
    CHECK(t->number(1) == 8);
    CHECK(file.warnings.empty());
}

TEST_CASE("lenient: CSV that tells spreadsheets its separator") {
    for (const char* text : {"sep=;\nx;y;z\n1;2;3\n", "sep=,\r\nx,y,z\r\n1,2,3\r\n"}) {
        const tf::mesh_file file = read_named(text, "a.csv");
        CHECK(file.mesh.points == std::vector<tf::point3>{{1, 2, 3}});
        CHECK(file.warnings.empty());
    }
    CHECK_FALSE(named_refusal("sep=;\n", "a.csv").empty());
}

TEST_CASE("lenient: CSV with numbers between quotes, and a comma behind the last name") {
    const tf::mesh_file file =
        read_named("\"x\",\"y\",\"z\",\"id\",\n\"1\",2,\"3\",\"7\"\n4,5,6,\"8\"\n", "a.csv");
    CHECK(file.mesh.points == std::vector<tf::point3>{{1, 2, 3}, {4, 5, 6}});
    const tf::column* const id = file.attributes.elements.at(0).find("id");
    REQUIRE(id != nullptr);
    CHECK(id->number(0) == 7);
    CHECK(id->number(1) == 8);
    CHECK(file.warnings.empty());
    CHECK_FALSE(named_refusal("x,y,z\n\"1,2,3\n", "a.csv").empty());
}

TEST_CASE("lenient: faces that are not convex are counted, others and flat corners are not") {
    const std::string points =
        "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 2 2 0.1\nv 1 0 0\n";
    const auto said = [&](const std::string& faces) {
        return warnings(read_named(points + faces, "a.obj"));
    };
    CHECK(said("f 1 2 3 7 6\nf 1 8 2 3\nf 1 2 3\n").empty());  // nearly flat; a corner on an edge
    CHECK(said("f 1 2 3 4 5 6\n").empty());  // all of it is seen from the first corner
    CHECK(said("f 6 1 2 3 4 5\nf 1 2 3\nf 5 4 3 2 1 6\n")
              .starts_with("concave-faces: 2 faces are not convex"));
}
