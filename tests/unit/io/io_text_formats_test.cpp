#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <string_view>

namespace {

tf::mesh_file read_text(std::string_view text, std::string_view name) {
    return tf::read(std::as_bytes(std::span(text)), name, {});
}

/// What the reader says against `text`; empty when it says nothing.
std::string text_complaint(std::string_view text, std::string_view name) {
    try {
        (void)read_text(text, name);
        return {};
    } catch (const tf::io_error& e) {
        return e.what();
    }
}

bool says_of_text(const std::string& text, std::string_view part) {
    return text.find(part) != std::string::npos;
}

const tf::column& text_column(const tf::mesh_file& file, std::string_view e,
                              std::string_view name) {
    const tf::element* found = file.attributes.find(e);
    REQUIRE(found != nullptr);
    const tf::column* c = found->find(name);
    REQUIRE(c != nullptr);
    return *c;
}

constexpr std::string_view triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

std::string with_triangle(std::string_view text) {
    return std::string(triangle) + std::string(text);
}

}  // namespace

TEST_CASE("obj: corners may be v, v/vt, v//vn, v/vt/vn, and count from the end when negative") {
    const std::string rows = "vt 0 0\nvt 1 0\nvt 0 1\nvn 1 0 0\nvn 0 1 0\nvn 0 0 1\n";
    for (const char* const face :
         {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//2 3//3", "f 1/1/1 2/2/2 3/3/3", "f -3 -2 -1",
          "f -3/-3/-3 -2/-2/-2 -1/-1/-1", "f\t1\t2\t3 # end", "  f 1 2 3  ", "f 1 2 \\\n3",
          "f 1 2 \\\r\n 3", "f 1 2 3\\\n\n"}) {
        CAPTURE(face);
        const tf::mesh_file file = read_text(with_triangle(rows + face), "a.obj");
        CHECK(file.mesh.faces == std::vector<tf::face>{{0, 1, 2}});
        CHECK(file.face_of_triangle.empty());
    }
}

TEST_CASE("obj: line ends may be CR, LF or CRLF, and errors count them alike") {
    for (const std::string end : {"\r", "\n", "\r\n"}) {
        const std::string text =
            "v 0 0 0" + end + "v 1 0 0" + end + "v 0 1 0" + end + end + "f 1 2 3" + end;
        CHECK(read_text(text, "a.obj").mesh.faces.size() == 1);
        CHECK(says_of_text(text_complaint(text + "f 1 2 x" + end, "a.obj"), "a.obj:6: expected"));
    }
}

TEST_CASE("obj: a polygon is a fan from its first corner, and repeated corners stay") {
    const tf::mesh_file file = read_text(with_triangle("f 1 2 3\nf 1 2 3 1\nf 3 2 1\n"), "a.obj");
    CHECK(file.mesh.faces == std::vector<tf::face>{{0, 1, 2}, {0, 1, 2}, {0, 2, 0}, {2, 1, 0}});
    CHECK(file.face_of_triangle == std::vector<std::uint32_t>{0, 1, 1, 2});
    CHECK(file.stored_faces == 3);
}

TEST_CASE("obj: faces may come ahead of their vertices; what never comes is named by its line") {
    CHECK(read_text("f 1 2 3\n" + std::string(triangle), "a.obj").mesh.faces.size() == 1);
    CHECK(says_of_text(text_complaint(with_triangle("f 1 2 3\nf 1 2 4\n"), "a.obj"),
                       "a.obj:5: vertex index '4' is out of range"));
    CHECK(says_of_text(text_complaint("f 1 1 1\n", "a.obj"),
                       "a.obj:1: vertex index '1' is out of range"));
    CHECK(says_of_text(text_complaint(with_triangle("f 0 1 2\n"), "a.obj"),
                       "a.obj:4: vertex index 0"));
    CHECK(says_of_text(text_complaint(with_triangle("f -4 1 2\n"), "a.obj"),
                       "a.obj:4: vertex index '-4'"));
    CHECK(says_of_text(text_complaint(with_triangle("f 1 2 3.5\n"), "a.obj"), "a.obj:4: expected"));
    CHECK(says_of_text(text_complaint(with_triangle("f 1 2 3-1\n"), "a.obj"), "a.obj:4: expected"));
}

TEST_CASE("obj and off: faces of fewer than three corners are left out") {
    tf::mesh_file file = read_text(with_triangle("f 1 2\nf 1 2 3\nf 2\nf 3 2 1\n"), "a.obj");
    CHECK(file.mesh.faces == std::vector<tf::face>{{0, 1, 2}, {2, 1, 0}});
    CHECK(file.stored_faces == 2);
    REQUIRE(file.warnings.size() == 1);
    CHECK(file.warnings[0].text ==
          "2 faces with fewer than three corners left out; faces are numbered without them");
    file = read_text("OFF 3 3 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1 9 9 9\n0\n3 0 1 2 1 2 3\n", "a.off");
    CHECK(file.mesh.faces.size() == 1);
    CHECK(file.stored_faces == 1);
    CHECK(text_column(file, "face", "red").number(0) == 1.0);
    CHECK(file.warnings.size() == 1);
}

TEST_CASE("off: no blank is needed between the first word and the counts") {
    CHECK(read_text("OFF3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.off").mesh.faces.size() == 1);
    CHECK(says_of_text(text_complaint("OFFx 1 0\n", "a.off"), "expected 'OFF'"));
}

TEST_CASE("stl text: the end may be two words; commas between numbers are named") {
    const std::string facet =
        "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\n";
    CHECK(read_text("solid\n" + facet + "end solid a\n", "a.stl").mesh.faces.size() == 1);
    CHECK(says_of_text(text_complaint("solid\n" + facet + "end\n", "a.stl"), "expected 'solid'"));
    CHECK(says_of_text(
        text_complaint("solid\nfacet normal 0 0 1\nouter loop\nvertex 0.0, 0.0, 0.0\n", "a.stl"),
        "numbers are separated by blanks, not by commas"));
}

TEST_CASE("obj: numbers end at blanks, and a comma is no decimal mark") {
    CHECK(says_of_text(text_complaint("v 1,5 0 0\n", "a.obj"),
                       "the decimal separator must be a point"));
    CHECK(says_of_text(text_complaint("v 0 0 1.#IND\n", "a.obj"), "a.obj:1: expected"));
    CHECK(says_of_text(text_complaint("v 0 0\n", "a.obj"),
                       "expected a coordinate, but the line ends"));
    const tf::mesh_file file = read_text("v nan -INF 1e400\n", "a.obj");
    CHECK(std::isnan(file.mesh.points[0].x));
    CHECK(file.mesh.points[0].y == -INFINITY);
    CHECK(file.mesh.points[0].z == INFINITY);
}

TEST_CASE("obj: names make parts, vertex colors a column each") {
    const tf::mesh_file file = read_text(
        "v 0 0 0 1 0.5 0\nv 1 0 0 0 0 1\nv 0 1 0 0 1 0\nf 1 2 3\no body\ng left arm\nusemtl red\n"
        "f 1 2 3\nf 1 2 3\nusemtl \nf 1 2 3\no next\n",
        "a.obj");
    CHECK(file.attributes.parts == std::vector<tf::named_faces>{{"body", "left arm", "red", 1},
                                                                {"body", "left arm", "", 3}});
    CHECK(text_column(file, "vertex", "green").number(0) == 0.5);
    CHECK(text_column(file, "vertex", "blue").number(1) == 1.0);
    const tf::mesh_file some = read_text("v 0 0 0 1 1 1\nv 1 0 0\nv 0 1 0 1 1 1\n", "a.obj");
    CHECK(some.attributes.elements.empty());
    CHECK(some.warnings.at(0).code == "vertex-colors");
}

TEST_CASE(
    "obj: points and lines are counted, other statements left alone, other files not opened") {
    const tf::mesh_file file = read_text(
        with_triangle(
            "mtllib ../../etc/passwd\nvt 0 0\nvn 0 0 1\ns off\np 1 2\nl 1 2 \\\n3\nf 1 2 3\n"),
        "a.obj");
    CHECK(file.mesh.faces.size() == 1);
    CHECK(file.warnings.at(0).text == "2 point and line elements were not read");
    CHECK(says_of_text(text_complaint("hello\nworld\n", "a.obj"), "not an OBJ file"));
}

TEST_CASE("stl text: any case, any blanks, several solids, normals of any kind") {
    const std::string facet =
        "FACET NORMAL -nan(ind) -nan(ind) -nan(ind)\r\n\tOuter Loop\rVERTEX 0 0 0\nvertex 1 0 0\n"
        "vertex 0 1 0\nendloop endfacet\n";
    const tf::mesh_file file =
        read_text("  SOLID first one\n" + facet + facet +
                      "endsolid\nsolid\nendsolid\nsolid last\n" + facet + "EndSolid whatever",
                  "a.stl");
    CHECK(file.mesh.faces == std::vector<tf::face>{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}});
    CHECK_FALSE(file.indexed);
    CHECK(file.attributes.parts == std::vector<tf::named_faces>{{"first one", "", "", 0},
                                                                {"", "", "", 2},
                                                                {"last", "", "", 2}});
}

TEST_CASE("stl text: a facet has three vertices and a file ends with endsolid") {
    const std::string start =
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
    CHECK(says_of_text(text_complaint(start + "endloop\nendfacet\nendsolid\n", "a.stl"),
                       "with 2 vertices"));
    CHECK(says_of_text(text_complaint(start + "vertex 0 1 0\nvertex 1 1 0\nendloop\n", "a.stl"),
                       "a.stl:7: facet with more than 3 vertices"));
    CHECK(says_of_text(text_complaint(start + "vertex 0 1 0\nendloop\nendfacet\n", "a.stl"),
                       "truncated?"));
    CHECK(says_of_text(text_complaint(start + "vertex 0 1,5 0\n", "a.stl"), "a.stl:6: expected"));
    CHECK(says_of_text(text_complaint(start + "vertex 0 1\n", "a.stl"), "a coordinate"));
}

TEST_CASE("off: first words, comments and counts") {
    const std::string cell = "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    for (const std::string head : {"OFF\n", "OFF ", "# c\nOFF # c\n\n", "", "nOFF 3\n"}) {
        CAPTURE(head);
        CHECK(read_text(head + cell, "a.off").mesh.faces == std::vector<tf::face>{{0, 1, 2}});
    }
    // Three more numbers are a point or a color; nobody can tell.
    CHECK(
        says_of_text(text_complaint("OFF\n3 1\n0 0 0 1 0 0 0 1 0\n3 0 1 2", "a.off"), "a.off:3:"));
    CHECK(read_text("OFF\n3 1\n0 0\n0\n1 0 0\n0 1 0\n3 0 1 2", "a.off").mesh.points.size() == 3);
    CHECK(says_of_text(text_complaint("OFF\n-3 1 0\n", "a.off"), "a.off:2: negative count"));
    CHECK(says_of_text(text_complaint("OFF\n3000000000 1 0\n0 0 0\n", "a.off"),
                       "larger than the file"));
    CHECK(says_of_text(text_complaint("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "a.off"),
                       "a.off:6: vertex index 3 is out of range"));
    CHECK(says_of_text(text_complaint("OFF BINARY\n", "a.off"), "binary OFF"));
    CHECK(says_of_text(text_complaint("OFF\n1 0 0\n0 0 0 255 0 0\n", "a.off"), "first word"));
    CHECK(says_of_text(text_complaint("4OFF\n1 0 0\n0 0 0 2\n", "a.off"), "weight"));
}

TEST_CASE("off: normals, colors and texture coordinates become columns") {
    const tf::mesh_file file = read_text(
        "STCNOFF\n3 2 0\n0 0 0 0 0 1 255 0 7 0.5 1\n1 0 0 0 0 1 1 2 3 0 0\n0 1 0 0 0 1 1 2 3 0 0\n"
        "3 0 1 2 1 0 0.5\n3 2 1 0 0 0 0\n",
        "a.off");
    CHECK(text_column(file, "vertex", "nz").number(0) == 1.0);
    CHECK(text_column(file, "vertex", "red").number(0) == 255.0);
    CHECK(text_column(file, "vertex", "t").number(0) == 1.0);
    CHECK(text_column(file, "face", "blue").number(0) == 0.5);
    const tf::mesh_file uneven =
        read_text("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 9\n3 2 1 0\n", "a.off");
    CHECK(text_column(uneven, "face", "off_color").list_begin ==
          std::vector<std::uint64_t>{0, 1, 1});
}

TEST_CASE("xyz: separators, headings, further columns") {
    for (const char* const text : {"1 2 3\n4 5 6\n", "1,2,3\n4,5,6\n", "1, 2, 3\n4, 5, 6\n",
                                   "1;2;3\n4;5;6", "1\t2\t3\r4\t5\t6", "2\n1 2 3\n4 5 6\n",
                                   "x y z\n1 2 3\n4 5 6\n", "//X Y Z\n# c\n1 2 3\n\n4 5 6\n"}) {
        CAPTURE(text);
        const tf::mesh_file file = read_text(text, "a.xyz");
        CHECK(file.mesh.points == std::vector<tf::point3>{{1, 2, 3}, {4, 5, 6}});
        CHECK(file.mesh.faces.empty());
    }
    CHECK(
        text_column(read_text("1 2 3 4 5\n1 2 3 4 6\n", "a.xyz"), "vertex", "column_5").number(1) ==
        6.0);
    CHECK(read_text("1 2 3 4\n1 2 3\n", "a.xyz").warnings.at(0).code == "columns");
    CHECK(says_of_text(text_complaint("1,5 2,5 3,5\n", "a.xyz"),
                       "the decimal separator must be a point"));
    CHECK(says_of_text(text_complaint("1 2 3\n1 2\n", "a.xyz"), "a.xyz:2:"));
    CHECK(says_of_text(text_complaint("1 2 3\nabc\n", "a.xyz"), "a.xyz:2: expected"));
}

TEST_CASE("pts: a count comes first, and columns have their usual names") {
    const auto names = [](std::string_view text, std::string_view name = "a.PTS") {
        const tf::mesh_file file = read_text(text, name);
        CHECK(file.warnings.empty());
        CHECK(file.format == "xyz");
        std::string all;
        if (const tf::element* e = file.attributes.find("vertex"))
            for (const tf::column& c : e->columns) all += c.name + " ";
        return all;
    };
    CHECK(names("1\n1 2 3\n").empty());
    CHECK(names("1\n1 2 3 -17\n") == "intensity ");
    CHECK(names("2 \r\n1 2 3 0.5\r\n4 5 6 0.25\r\n") == "intensity ");
    CHECK(names("1\n1 2 3 10 20 30\n") == "red green blue ");
    CHECK(names("1\n1 2 3 5 10 20 30\n") == "intensity red green blue ");
    CHECK(names("1\n1 2 3 5 10\n") == "column_4 column_5 ");
    CHECK(names("1 2 3 4\n") == "column_4 ");
    CHECK(names("1 2 3 4\n", "a.xyz") == "column_4 ");
    const tf::mesh_file file = read_text("2\n1 2 3 5 10 20 30\n4 5 6 7 40 50 60\n", "a.pts");
    CHECK(file.mesh.points == std::vector<tf::point3>{{1, 2, 3}, {4, 5, 6}});
    CHECK(text_column(file, "vertex", "intensity").number(1) == 7);
    CHECK(text_column(file, "vertex", "blue").number(0) == 30);
}

TEST_CASE("pts: a wrong count is a warning, and an error where points are missing") {
    const tf::mesh_file more = read_text("1\n1 2 3\n4 5 6\n", "a.pts");
    CHECK(more.mesh.points.size() == 2);
    REQUIRE(more.warnings.size() == 1);
    CHECK(more.warnings[0].code == "count");
    CHECK(more.warnings[0].text == "1 points announced, 2 found");
    CHECK(
        says_of_text(text_complaint("3\n1 2 3\n4 5 6\n", "a.pts"), "3 points announced, 2 found"));
    CHECK(
        says_of_text(text_complaint("99999999999999999\n1 2 3\n", "a.pts"), "announced, 1 found"));
    CHECK(says_of_text(text_complaint("2\n", "a.pts"), "no points found"));
    CHECK(read_text("1.5\n1 2 3\n", "a.pts").warnings.at(0).code == "heading");
    CHECK(read_text("7\n1 2 3\n", "a.xyz").warnings.at(0).code == "heading");
}

TEST_CASE("csv: a heading names the columns, x y z are found by name, and text comes back") {
    const tf::mesh_file file =
        read_text("id,\"Z\",y,\"a \"\"b\"\", c\",x\n7,3,2,0.5,1\n8,6,5,-1,4\n", "a.csv");
    CHECK(file.format == "csv");
    CHECK(file.warnings.empty());
    CHECK(file.mesh.points == std::vector<tf::point3>{{1, 2, 3}, {4, 5, 6}});
    CHECK(text_column(file, "vertex", "id").number(1) == 8.0);
    CHECK(text_column(file, "vertex", "a_\"b\",_c").number(0) == 0.5);
    const std::string csv = tf::write_to_memory(file, {.format = "csv"});
    CHECK(csv == "id,z,y,\"a_\"\"b\"\",_c\",x\n7,3,2,0.5,1\n8,6,5,-1,4\n");
    CHECK(read_text(csv, "a.csv").attributes == file.attributes);
    CHECK(read_text(csv, "stdin").format == "csv");
    // The properties of another format come with their names.
    const tf::mesh_file plain = read_text("1 2 3 4\n5 6 7 8\n", "a.xyz");
    CHECK(tf::write_to_memory(plain, {.format = "csv"}) == "x,y,z,column_4\n1,2,3,4\n5,6,7,8\n");
    CHECK(tf::write_to_memory(file, {.format = "txt"}) == "1 2 3 7 0.5\n4 5 6 8 -1\n");
}

TEST_CASE("csv: coordinates are found by what surveyors and other programs call them") {
    tf::mesh_file file = read_text("Point,Northing,Easting,Elevation\n7,2,1,3\n", "a.csv");
    CHECK(file.mesh.points == std::vector<tf::point3>{{1, 2, 3}});
    REQUIRE(file.warnings.size() == 1);
    CHECK(file.warnings[0].text ==
          "x, y and z are the columns 'Easting', 'Northing' and 'Elevation'");
    for (const std::string heading :
         {"id;E;N;H", "n;pos_X;pos_y;pos_z", "a;\"Points:0\";\"Points:1\";\"Points:2\""}) {
        file = read_text(heading + "\n7;1;2;3\n", "a.csv");
        CHECK(file.mesh.points == std::vector<tf::point3>{{1, 2, 3}});
        CHECK(file.warnings.at(0).code == "columns");
    }
    // Where there are x, y and z, they are meant.
    file = read_text("e,n,h,x,y,z\n1,2,3,4,5,6\n", "a.csv");
    CHECK(file.mesh.points == std::vector<tf::point3>{{4, 5, 6}});
    CHECK(file.warnings.empty());
    CHECK(says_of_text(text_complaint("latitude,longitude,height\n1,2,3\n", "a.csv"),
                       "a.csv:1: latitude and longitude are angles"));
}

TEST_CASE("csv: headings of other programs, and those that are of no use") {
    for (const char* const text :
         {"//X Y Z Intensity\n1 2 3 4\n", "//X Y Z Intensity\n1\n1 2 3 4\n",
          "# x y z Intensity\n1 2 3 4", "X\tY\tZ\tIntensity\n1\t2\t3\t4\n",
          "x;y;z;Intensity\n1;2;3;4\n", "Intensity z y x\n4 3 2 1\n",
          "x, y, z, Intensity\n1, 2, 3, 4\n"}) {
        CAPTURE(text);
        const tf::mesh_file file = read_text(text, "a.txt");
        CHECK(file.mesh.points == std::vector<tf::point3>{{1, 2, 3}});
        CHECK(text_column(file, "vertex", "Intensity").number(0) == 4.0);
    }
    CHECK(read_text("width,depth,height\n1,2,3\n", "a.csv").warnings.at(0).code == "heading");
    CHECK(read_text("# some words here more\n1 2 3 4\n", "a.xyz").attributes ==
          read_text("1 2 3 4\n", "a.xyz").attributes);
    // Fewer names than values: they are numbered.
    CHECK(text_column(read_text("x,y,z\n1,2,3,4\n", "a.csv"), "vertex", "column_4").number(0) == 4);
    CHECK(read_text("x y z\n1 2 3\n", "stdin").format == "xyz");
    CHECK(says_of_text(text_complaint("x,y,z\n", "a.csv"), "no points found"));
    CHECK(says_of_text(text_complaint("a,x,y,z\n1,2,3,4\n1,2,3\n", "a.csv"), "a.csv:3:"));
    CHECK(says_of_text(text_complaint("a,x,y,z\n1,2,3,\n", "a.csv"), "a.csv:2:"));
}

TEST_CASE("csv: empty cells and words are NaN where they stand, which is said") {
    const tf::mesh_file file =
        read_text("x,y,z,a,b\n1,2,3,5,7\n2,2,3,,8\n3,2,3,a \"b\" c,\n4,2,3,\"d, e\",9\n", "a.csv");
    const auto values = [&](const char* name) {
        std::string text;
        for (std::size_t i = 0; i < 4; ++i) {
            const double value = text_column(file, "vertex", name).number(i);
            text += std::isnan(value) ? "-" : std::to_string(static_cast<int>(value));
        }
        return text;
    };
    CHECK(values("a") == "5---");
    CHECK(values("b") == "78-9");
    REQUIRE(file.warnings.size() == 1);
    CHECK(file.warnings[0].text == "4 cells of a, b empty or not a number: read as NaN");
    CHECK(read_text("1 2 3 oak\n1 2 3 4\n", "a.xyz").warnings.at(0).text ==
          "1 cell of column_4 empty or not a number: read as NaN");
    CHECK(says_of_text(text_complaint("1;2;3;4,5\n", "a.csv"), "decimal separator"));
}

TEST_CASE("csv: whole numbers beyond 2^53 stay, colors are of 8 or 16 bits, the rest doubles") {
    const auto column = [](const std::string& text, const char* name) {
        return text_column(read_text(text, "a.csv"), "vertex", name);
    };
    const std::string large = "x,y,z,t\n1,2,3,1234567890123456789\n1,2,3,-1234567890123456788\n";
    CHECK(column(large, "t") ==
          tf::column::of<std::int64_t>(
              "t", std::vector<std::int64_t>{1234567890123456789, -1234567890123456788}));
    CHECK(column("x,y,z,t\n1,2,3,18446744073709551615\n", "t").type == tf::scalar_type::uint64);
    const tf::mesh_file mixed =
        read_text("x,y,z,t\n1,2,3,1234567890123456789\n1,2,3,0.5\n", "a.csv");
    CHECK(text_column(mixed, "vertex", "t").type == tf::scalar_type::float64);
    CHECK(mixed.warnings.at(0).text.find("2^53") != std::string::npos);
    CHECK(column("x,y,z,t\n1,2,3,9007199254740992\n", "t").type == tf::scalar_type::float64);
    const std::string colors = "x,y,z,red,green,blue\n1,2,3,0,0,255\n";
    CHECK(column(colors, "blue").type == tf::scalar_type::uint8);
    CHECK(column(colors + "1,2,3,0,256,0\n", "blue").type == tf::scalar_type::uint16);
    CHECK(column(colors + "1,2,3,0,0.5,0\n", "blue").type == tf::scalar_type::float64);
}

TEST_CASE("csv: columns are what they are said to be") {
    using name_pairs = std::vector<std::pair<std::string, std::string>>;
    const auto chosen = [](const std::string& text, name_pairs columns) {
        return tf::read(std::as_bytes(std::span(text)), "a.csv", {},
                        {.columns = std::move(columns)});
    };
    const std::string text = "id;E;N;H;I\n7;1;2;3;9\n8;4;5;6;10\n";
    const tf::mesh_file file =
        chosen(text, {{"x", "N"}, {"y", "E"}, {"z", "4"}, {"intensity", "I"}});
    CHECK(file.mesh.points == std::vector<tf::point3>{{2, 1, 3}, {5, 4, 6}});
    CHECK(text_column(file, "vertex", "intensity").number(1) == 10);
    CHECK(text_column(file, "vertex", "id").number(1) == 8);
    CHECK(file.warnings.empty());
    const tf::mesh_file plain = chosen("9 1 2 3\n", {{"x", "2"}, {"y", "3"}, {"z", "4"}});
    CHECK(plain.mesh.points == std::vector<tf::point3>{{1, 2, 3}});
    CHECK(text_column(plain, "vertex", "column_1").number(0) == 9);
    const auto complaint = [&](const name_pairs& columns) -> std::string {
        try {
            (void)chosen(text, columns);
        } catch (const tf::io_error& error) {
            return error.what();
        }
        return {};
    };
    CHECK(complaint({{"x", "X"}, {"y", "E"}, {"z", "H"}}).find("'X' among id, E, N, H, I") !=
          std::string::npos);
    CHECK(complaint({{"x", "E"}}).find("together") != std::string::npos);
    CHECK(complaint({{"x", "E"}, {"y", "E"}, {"z", "H"}}).find("three") != std::string::npos);
}

TEST_CASE("detection: what is no LAS is not read as LAS") {
    CHECK(says_of_text(text_complaint(std::string_view("LASF\0\0\1\2", 8), "stdin"),
                       "ends within the header"));
    CHECK(says_of_text(text_complaint("anything", "a.laz"), "not a LAS or LAZ file"));
}

TEST_CASE("detection: the content comes first, then the name") {
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
        "property float y\nproperty float z\nend_header\n1 2 3\n";
    CHECK(read_text(ply, "a.stl").format == "ply-ascii");
    CHECK(read_text("OFF\n0 0 0\n", "a.obj").format == "off");
    CHECK(read_text("# c\nv 1 2 3\n", "stdin").format == "obj");
    CHECK(read_text("1 2 3\n", "stdin").format == "xyz");
    CHECK(read_text("VERSION 1\nFIELDS x y z\nPOINTS 1\nDATA ascii\n1 2 3\n", "a.xyz").format ==
          "pcd-ascii");
    CHECK(read_text("solid\nendsolid\n", "stdin").format == "stl-ascii");
    CHECK(read_text("\xef\xbb\xbfv 1 2 3\n", "a.obj").mesh.points.size() == 1);
    CHECK(says_of_text(text_complaint("", "a.obj"), "a.obj: empty file"));
    CHECK(says_of_text(text_complaint(std::string_view("\xff\xfev\0 \0", 6), "a.obj"), "UTF-16"));
    CHECK(says_of_text(text_complaint("hello", "a.nothing"), "not in a supported format"));
    CHECK(says_of_text(text_complaint("hello", "stdin"), "not in a supported format"));
}

TEST_CASE("detection: a binary STL is one by its size, whatever its header says") {
    std::string stl = "solid facet normal";
    stl.resize(84 + 50, '\0');
    stl[80] = 1;
    CHECK(read_text(stl, "a.stl").format == "stl-binary");
    CHECK(read_text(stl, "stdin").mesh.faces.size() == 1);
    CHECK(read_text(stl + "x", "a.stl").format == "stl-binary");
    stl.resize(stl.size() - 1);
    CHECK(says_of_text(text_complaint(stl, "a.stl"),
                       "the header announces 1 triangles, the file has 0"));
}

TEST_CASE("reading: a missing file and a folder are named") {
    CHECK_THROWS_WITH_AS(static_cast<void>(tf::read("/nonexistent/a.stl")),
                         "/nonexistent/a.stl: No such file or directory", tf::io_error);
    CHECK_THROWS_WITH_AS(static_cast<void>(tf::read("/")), "/: Is a directory", tf::io_error);
}
