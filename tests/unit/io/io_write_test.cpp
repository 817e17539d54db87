#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace {

tf::mesh_file read_again(const std::string& bytes, const std::string& name) {
    return tf::read(std::as_bytes(std::span(bytes)), name, {});
}

std::string written(const tf::mesh_file& file, const char* format, bool ascii = false) {
    return tf::write_to_memory(file, {.format = format, .ascii = ascii});
}

/// A tetrahedron of random doubles.
tf::mesh_file tetrahedron(unsigned seed) {
    std::mt19937_64 random(seed);
    tf::mesh_file file;
    for (int v = 0; v < 4; ++v) {
        const auto next = [&] { return static_cast<double>(random()) * 0x1p-61 - 4.0; };
        const double x = next();
        const double y = next();
        file.mesh.points.push_back({x, y, next()});
    }
    file.mesh.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    file.stored_faces = 4;
    return file;
}

/// Every type, scalar and list, in all elements, around and between the coordinates.
const std::string rich_ply =
    "ply\nformat ascii 1.0\ncomment first\ncomment  two  blanks\nobj_info scanner 7\n"
    "element camera 1\nproperty double fov\n"
    "element vertex 4\nproperty char a\nproperty float x\nproperty uchar red\nproperty float y\n"
    "property float z\nproperty list uchar short tags\nproperty float quality\n"
    "element edge 2\nproperty int vertex1\nproperty int vertex2\nproperty ushort w\n"
    "element face 2\nproperty uint id\nproperty list ushort uint vertex_index\n"
    "property list uint double weights\n"
    "element nothing 0\nproperty float x\n"
    "end_header\n"
    "0.1\n"
    "-128 0 255 0 0 0 0.1\n127 1 0 0 0 3 -32768 0 32767 1e-45\n0 1 7 1 0 1 5 nan\n"
    "1 0 8 1 -0 0 -inf\n"
    "0 1 65535\n2 3 1\n"
    "4294967295 4 0 1 2 3 2 0.1 -1e300\n7 3 0 1 2 0\n";

std::filesystem::path written_folder() {
    const auto folder =
        std::filesystem::temp_directory_path() / ("io_write_test." + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    return folder;
}

std::size_t files_in(const std::filesystem::path& folder) {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

}  // namespace

TEST_CASE("ply: every element and property survives in order, name, type and value") {
    tf::mesh_file file = read_again(rich_ply, "a.ply");
    CHECK(file.mesh.points.size() == 4);
    CHECK(file.mesh.faces == std::vector<tf::face>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}});
    CHECK(file.attributes.elements.size() == 5);
    CHECK(file.attributes.comments == std::vector<std::string>{"first", " two  blanks"});
    const std::string ascii = written(file, "ply", true);
    CHECK(read_again(ascii, "b.ply").attributes == file.attributes);
    // Once more: the text is already as short as it gets.
    CHECK(written(read_again(ascii, "b.ply"), "ply", true) == ascii);
    const std::string little = written(file, "ply");
    CHECK(read_again(little, "b.ply").attributes == file.attributes);
    CHECK(written(read_again(little, "b.ply"), "ply") == little);
    file.format = "ply-binary-be";
    const std::string big = written(file, "ply");
    CHECK(read_again(big, "b.ply").format == "ply-binary-be");
    CHECK(read_again(big, "b.ply").attributes == file.attributes);
    CHECK(written(read_again(big, "b.ply"), "ply") == big);
    CHECK(read_again(big, "b.ply").mesh == file.mesh);
}

TEST_CASE("ply: binary is what another program would write") {
    tf::mesh_file file;
    file.mesh.points = {{1, 2, 3}, {-0.5, 0, 0}, {0, 1, 0}};
    file.mesh.faces = {{0, 1, 2}};
    file.stored_as = tf::precision::float32;
    const std::string bytes = written(file, "ply");
    const std::string head =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
        "property float y\nproperty float z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n";
    CHECK(bytes.substr(0, head.size()) == head);
    CHECK(bytes.size() == head.size() + 36 + 13);
    CHECK(bytes.substr(head.size(), 4) == std::string("\0\0\x80\x3f", 4));
    CHECK(bytes.substr(head.size() + 36, 5) == std::string("\3\0\0\0\0", 5));
}

TEST_CASE("ply: a polygon of 300 corners widens a byte-sized list length") {
    tf::mesh_file file;
    for (std::uint32_t v = 0; v < 300; ++v) {
        file.mesh.points.push_back({double(v), double(v) * v, 0});
        if (v >= 2) file.mesh.faces.push_back({0, v - 1, v});
    }
    file.face_of_triangle.assign(298, 0);
    for (const bool ascii : {false, true}) {
        const auto again = read_again(written(file, "ply", ascii), "a.ply");
        CHECK(again.stored_faces == 1);
        CHECK(again.mesh.faces == file.mesh.faces);
    }
}

TEST_CASE("writing: doubles survive in every format that holds them") {
    for (unsigned seed = 0; seed < 200; ++seed) {
        const tf::mesh_file file = tetrahedron(seed);
        for (const char* const format : {"obj", "off", "ply", "xyz"})
            for (const bool ascii : {false, true}) {
                CAPTURE(format);
                CHECK(read_again(written(file, format, ascii), std::string("a.") + format)
                          .mesh.points == file.mesh.points);
            }
        const auto stl = read_again(written(file, "stl", true), "a.stl");
        for (std::size_t f = 0; f < 4; ++f)
            for (std::size_t c = 0; c < 3; ++c)
                CHECK(stl.mesh.points[3 * f + c] == file.mesh.points[file.mesh.faces[f][c]]);
    }
}

TEST_CASE("writing: rounding to float32 is reported, and refused where it would be infinite") {
    tf::mesh_file file = tetrahedron(1);
    file.mesh.points[0].x = 0.1;
    const auto folder = written_folder();
    const auto result = tf::write(folder / "a.stl", file);
    CHECK(result.format == "stl-binary");
    CHECK(result.written_as == tf::precision::float32);
    CHECK(result.max_displacement > 0);
    CHECK(result.max_displacement < 1e-6);
    const auto again = tf::read(folder / "a.stl");
    CHECK(again.mesh.points[0].x == static_cast<double>(0.1F));
    CHECK(tf::write(folder / "b.stl", again).max_displacement == 0.0);
    for (const char* const format : {"ply", "obj", "off"}) {
        const auto text = tf::write_to_memory(
            file, {.format = format, .ascii = true, .precision = tf::precision::float32});
        CHECK(read_again(text, std::string("a.") + format).mesh.points[0].x ==
              static_cast<double>(0.1F));
    }
    file.mesh.points[0].x = 1e300;
    CHECK_THROWS_AS(tf::write(folder / "c.stl", file), tf::io_error);
    CHECK(written(file, "obj").starts_with("v 1e+300 "));
    std::filesystem::remove_all(folder);
}

TEST_CASE("stl: header, names of solids and attribute bits come back") {
    tf::mesh_file file = tetrahedron(2);
    file.attributes.parts = {{.object = "one", .first_face = 0},
                             {.object = "two", .first_face = 3}};
    CHECK(read_again(written(file, "stl", true), "a.stl").attributes.parts ==
          file.attributes.parts);
    const std::vector<std::uint16_t> bits{0, 0, 65535, 7};
    file.attributes.find_or_add("face", 4).columns.push_back(
        tf::column::of<std::uint16_t>("stl_attribute", bits));
    file.attributes.header = "HEADER" + std::string(73, '*') + '\0';
    const std::string bytes = written(file, "stl");
    CHECK(bytes.size() == 84 + 4 * 50);
    const auto again = read_again(bytes, "a.stl");
    CHECK(again.attributes.header == file.attributes.header);
    CHECK(again.attributes.elements == file.attributes.elements);
    CHECK(written(again, "stl") == bytes);
}

TEST_CASE("stl: the header is text that a NUL ends, and never begins with solid") {
    const auto header_for = [](std::string header) {
        tf::mesh_file file = tetrahedron(2);
        file.attributes.header = std::move(header);
        return written(file, "stl").substr(0, 80);
    };
    const auto padded = [](std::string text) {
        text.resize(80, '\0');
        return text;
    };
    CHECK(header_for("") == padded("treeform"));
    CHECK(header_for("of another length") == padded("treeform"));
    CHECK(header_for(std::string(80, '*')) == padded(std::string(79, '*')));
    CHECK(header_for(std::string(80, ' ')) == padded(""));
    CHECK(header_for("a b" + std::string(77, ' ')) == padded("a b"));
    CHECK(header_for("a" + std::string(1, '\0') + std::string(78, ' ')) ==
          "a" + std::string(1, '\0') + std::string(78, ' '));
    CHECK(header_for("solid" + std::string(75, '*')) == padded(std::string(75, '*')));
    CHECK(header_for("solid  solid a" + std::string(66, ' ')) == padded("a"));
    CHECK(header_for("solid" + std::string(75, ' ')) == padded(""));
    CHECK(header_for(padded("solid")) == padded(""));
}

TEST_CASE("obj: parts, colors and polygons come back") {
    const std::string text =
        "v 0 0 0 1 0.5 0\nv 1 0 0 0 0 1\nv 1 1 0 0 1 0\nv 0 1 0 0 0 0\nf 1 2 3 4\no a\ng b\n"
        "usemtl c\nf 1 2 3\no d\nf 2 3 4\n";
    CHECK(written(read_again(text, "a.obj"), "obj") == text);
}

TEST_CASE("off: colors come back, and 1.0 stays apart from 1") {
    for (const std::string text :
         {"OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 1 0\n3 2 1 0 1 2 3\n",
          "STCNOFF\n3 1 0\n0 0 0 0.0 0.0 1.0 1.0 0.0 0.5 0.0 0.0\n1 0 0 0.0 0.0 1.0 1.0 0.0 0.5 "
          "0.0 0.0\n"
          "0 1 0 0.0 0.0 1.0 1.0 0.0 0.5 0.0 0.0\n3 0 1 2 1.0 0.0 0.5 0.25\n"}) {
        // The reader keeps the columns of a row in the order of the file.
        CAPTURE(text);
        if (text.starts_with("OFF")) CHECK(written(read_again(text, "a.off"), "off") == text);
        const auto once = written(read_again(text, "a.off"), "off");
        CHECK(read_again(once, "a.off").attributes == read_again(text, "a.off").attributes);
    }
}

TEST_CASE("glb: coordinates, one primitive a color, and an offset that loses nothing") {
    tf::mesh_file file = tetrahedron(3);
    for (auto& p : file.mesh.points)
        p = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    const std::vector<std::uint8_t> red{255, 0, 255, 0};
    const std::vector<std::uint8_t> none(4, 0);
    auto& columns = file.attributes.find_or_add("face", 4).columns;
    columns.push_back(tf::column::of<std::uint8_t>("red", red));
    columns.push_back(tf::column::of<std::uint8_t>("green", none));
    columns.push_back(tf::column::of<std::uint8_t>("blue", none));
    const std::string bytes = written(file, "glb");
    CHECK(bytes.size() % 4 == 0);
    CHECK(bytes.find("\"materials\":[{\"doubleSided\":true,\"pbrMetallicRoughness\":"
                     "{\"baseColorFactor\":[1.0,0.0,0.0,1.0]") != std::string::npos);
    // Far from the origin float32 alone would lose most digits.
    tf::mesh_file far = file;
    for (auto& p : far.mesh.points) p = {p.x + 0x1p20, p.y - 0x1p22, p.z};
    const auto folder = written_folder();
    CHECK(tf::write(folder / "far.glb", far).max_displacement < 1e-6);
    CHECK(read_again(bytes, "a.glb").mesh.faces.size() == 4);
    CHECK(std::abs(tf::read(folder / "far.glb").mesh.points[0].y) > 0x1p21);
    std::filesystem::remove_all(folder);
}

TEST_CASE("glb: whole numbers of faces are in the order of the faces") {
    tf::mesh_file file = tetrahedron(3);
    auto& columns = file.attributes.find_or_add("face", 4).columns;
    columns.push_back(tf::column::of<std::uint32_t>("id", std::vector<std::uint32_t>{4, 5, 6, 7}));
    columns.push_back(tf::column::of<float>("heat", std::vector<float>{4, 5, 6, 7}));
    columns.push_back(tf::column::of<std::int8_t>("sign", std::vector<std::int8_t>{1, -1, 1, 1}));
    const std::string bytes = written(file, "glb");
    CHECK(bytes.find("\"face_properties\":{\"id\":2}") != std::string::npos);
    CHECK(bytes.substr(bytes.size() - 16) == std::string("\4\0\0\0\5\0\0\0\6\0\0\0\7\0\0\0", 16));
}

TEST_CASE("writing: a mesh of nothing is read again as one") {
    for (const char* format : {"obj", "stl", "ply", "off", "glb"})
        for (const bool ascii : {false, true}) {
            CAPTURE(format);
            const std::string bytes = written({}, format, ascii);
            CHECK(!bytes.empty());
            CHECK(read_again(bytes, std::string("a.") + format).mesh == tf::mesh{});
        }
    CHECK_THROWS_AS(static_cast<void>(read_again("hello\n", "a.obj")), tf::io_error);
    CHECK_THROWS_AS(static_cast<void>(read_again("", "a.obj")), tf::io_error);
}

TEST_CASE("writing: a file appears whole or not at all") {
    const auto folder = written_folder();
    const tf::mesh_file good = tetrahedron(4);
    CHECK_THROWS_AS(tf::write(folder / "none" / "a.ply", good), tf::io_error);
    CHECK_THROWS_AS(tf::write(folder / "a.step", good), tf::io_error);
    CHECK_THROWS_AS(tf::write(folder, good, {.format = "ply"}), tf::io_error);
    tf::mesh_file points;
    points.mesh.points = good.mesh.points;
    CHECK_THROWS_AS(tf::write(folder / "a.stl", points), tf::io_error);
    CHECK(files_in(folder) == 0);
    tf::write(folder / "a.obj", good);
    std::filesystem::create_symlink("a.obj", folder / "link.obj");
    tf::write(folder / "link.obj", tetrahedron(5));
    CHECK(std::filesystem::is_symlink(folder / "link.obj"));
    CHECK(tf::read(folder / "a.obj").mesh == tetrahedron(5).mesh);
    CHECK(files_in(folder) == 2);
    std::filesystem::remove_all(folder);
    if (std::filesystem::exists("/dev/full")) {
        CHECK_THROWS_WITH_AS(tf::write("/dev/full", good, {.format = "ply"}),
                             "/dev/full: No space left on device", tf::io_error);
    }
}

TEST_CASE("writing: data that cannot be meant is refused") {
    tf::mesh_file file = tetrahedron(6);
    file.mesh.faces[2][1] = 4;
    CHECK_THROWS_AS((void)written(file, "obj"), std::invalid_argument);
    file = tetrahedron(6);
    file.attributes.elements.push_back({.name = "vertex", .rows = 3});
    CHECK_THROWS_AS((void)written(file, "ply"), std::invalid_argument);
    file = tetrahedron(6);
    file.face_of_triangle = {0, 1, 1, 2};  // triangles 1 and 2 are no fan
    CHECK_THROWS_AS((void)written(file, "ply"), std::invalid_argument);
    file = tetrahedron(6);
    file.attributes.find_or_add("face", 4).columns.push_back(
        tf::column::of<double>("x", std::span<const double>()));
    CHECK_THROWS_AS((void)written(file, "ply"), std::invalid_argument);
}

TEST_CASE("polygons: splitting repeats the rows of faces and renumbers parts") {
    tf::mesh_file file = read_again(
        "o a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 1 2 3\no b\nf 2 3 4\n", "a.obj");
    const std::vector<int> numbers{10, 20, 30};
    file.attributes.find_or_add("face", 3).columns.push_back(
        tf::column::of<std::int32_t>("n", numbers));
    file.split_polygons();
    const std::vector<int> expected{10, 10, 20, 30};
    CHECK(file.attributes.elements[0].columns[0] == tf::column::of<std::int32_t>("n", expected));
    CHECK(file.attributes.parts[1].first_face == 3);
    CHECK(file.stored_faces == 4);
    CHECK(read_again(written(file, "ply"), "a.ply").face_of_triangle.empty());
}

namespace {

std::string content(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("write: stopped while it writes, nothing appears") {
    const auto folder = written_folder();
    tf::mesh_file file = tetrahedron(1);
    file.mesh.points.resize(200000, {0.1, 0.2, 0.3});
    for (const char* name : {"m.ply", "m.obj", "m.3mf"}) {
        CAPTURE(name);
        const std::size_t before = files_in(folder);
        int calls = 0;
        const auto done =
            tf::write(folder / name, file, {.progress = [&](double) { return ++calls < 3; }});
        CHECK(done.status == tf::status::cancelled);
        CHECK(calls == 3);
        CHECK(files_in(folder) == before);
    }
    std::filesystem::remove_all(folder);
}

TEST_CASE("read and write: what the system refuses is told with its reason") {
    const auto folder = written_folder();
    const auto reason_of = [](const auto& verb) {
        try {
            verb();
        } catch (const tf::io_error& error) {
            return std::pair{error.reason(), std::string(error.path())};
        }
        return std::pair{std::error_code(), std::string()};
    };
    const auto gone = folder / "gone" / "m.ply";
    for (const auto& [reason, path] : {reason_of([&] { (void)tf::read(gone); }),
                                       reason_of([&] { tf::write(gone, tetrahedron(1)); })}) {
        CHECK(reason == std::errc::no_such_file_or_directory);
        CHECK(path == gone.string());
    }
    CHECK(reason_of([&] { (void)tf::read(folder); }).first == std::errc::is_a_directory);
    const auto [reason, path] = reason_of([] { (void)read_again("OFF 1", "m.off"); });
    CHECK(!reason);
    CHECK(path.empty());
    std::filesystem::remove_all(folder);
}

TEST_CASE("curves: written as lines of an OBJ or as edges of a PLY") {
    // Two triangles that cross in a segment, and a third that touches the first in a point.
    const tf::mesh mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {2, 1, 1}},
                        {{0, 1, 2}, {3, 4, 5}}};
    const auto pairs = tf::self_intersections(mesh).pairs;
    REQUIRE(pairs.size() == 1);
    const std::filesystem::path folder = written_folder();
    const tf::pair_column kinds{"kind", {7}};
    tf::write_curves(folder / "lines.obj", mesh, pairs, {&kinds, 1});
    CHECK(content(folder / "lines.obj") == "v 1 1 0\nv 1.5 1 0\nl 1 2\n");
    tf::write_curves(folder / "lines.dat", mesh, pairs, {&kinds, 1}, "ply");
    const std::string ply = content(folder / "lines.dat");
    CHECK(ply.ends_with("property int kind\nend_header\n1 1 0\n1.5 1 0\n0 1 7\n"));
    CHECK(ply.find("element edge 1\n") != std::string::npos);
    CHECK_THROWS_AS(tf::write_curves(folder / "lines.stl", mesh, pairs), tf::io_error);
    CHECK_THROWS_AS(tf::write_curves(folder / "none" / "lines.obj", mesh, pairs), tf::io_error);
    const tf::pair_column wrong{"kind", {}};
    CHECK_THROWS_AS(tf::write_curves(folder / "lines.obj", mesh, pairs, {&wrong, 1}),
                    std::invalid_argument);
}
