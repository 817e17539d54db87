#include <libmesh/io/lzf.hpp>
#include <treeform/mesh/point_stream.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace std::string_literals;

tf::mesh_file read_pcd(std::string_view bytes, std::string_view name = "a.pcd") {
    return tf::read(std::as_bytes(std::span(bytes)), name, {});
}

std::string written_pcd(const tf::mesh_file& file, const char* format, bool ascii = false) {
    return tf::write_to_memory(file, {.format = format, .ascii = ascii});
}

/// What the reader says against the bytes; empty when it says nothing.
std::string pcd_complaint(const std::string& bytes) {
    try {
        (void)read_pcd(bytes);
        return {};
    } catch (const tf::io_error& e) {
        return e.what();
    }
}

bool holds(const std::string& text, std::string_view part) {
    return text.find(part) != std::string::npos;
}

const tf::element& vertices_of(const tf::mesh_file& file) {
    const tf::element* e = file.attributes.find("vertex");
    REQUIRE(e != nullptr);
    return *e;
}

const tf::column& column_of(const tf::mesh_file& file, std::string_view name) {
    const tf::column* c = vertices_of(file).find(name);
    REQUIRE(c != nullptr);
    return *c;
}

template <class T>
std::string raw(T value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

std::string packed_pcd(const std::string& bytes) {
    std::string to(tf::detail::io::lzf_most_packed(bytes.size()), '\0');
    to.resize(tf::detail::io::lzf_pack(bytes, to.data()));
    return to;
}

/// What came out of the packed bytes; "?" when they are refused.
std::string unpacked(const std::string& bytes, std::size_t size) {
    std::string to(size, '\0');
    return tf::detail::io::lzf_unpack(bytes, to.data(), size) ? to : "?";
}

/// A header by hand.
std::string head(const std::string& fields, const std::string& sizes, const std::string& types,
                 const std::string& counts, std::size_t points, const std::string& data) {
    const std::string n = std::to_string(points);
    return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS " + fields + "\nSIZE " +
           sizes + "\nTYPE " + types + "\nCOUNT " + counts + "\nWIDTH " + n +
           "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + n + "\nDATA " + data + "\n";
}

std::string xyz_head(std::size_t points, const std::string& data) {
    return head("x y z", "4 4 4", "F F F", "1 1 1", points, data);
}

/// Every type of field, extreme values, one of several values.
tf::mesh_file rich() {
    tf::mesh_file file;
    file.mesh.points = {{0.5, -0.0, 3}, {NAN, NAN, NAN}, {1e300, 5e-324, -7}};
    tf::element& e = file.attributes.find_or_add("vertex", 3);
    const auto add = [&]<class T>(const char* name, T) {
        const T values[] = {std::numeric_limits<T>::min(), std::numeric_limits<T>::max(), T{1}};
        e.columns.push_back(tf::column::of<T>(name, values));
    };
    add("i1", std::int8_t{});
    add("u1", std::uint8_t{});
    add("i2", std::int16_t{});
    add("u2", std::uint16_t{});
    add("i4", std::int32_t{});
    add("u4", std::uint32_t{});
    add("i8", std::int64_t{});
    add("u8", std::uint64_t{});
    add("f4", float{});
    add("f8", double{});
    add("fpfh[0]", float{});
    add("fpfh[1]", float{});
    add("fpfh[2]", float{});
    add("odd[1]", float{});
    add("alone[0]", float{});
    const std::uint32_t colors[] = {0xff818283U, 0x00010203U, 0xff8182c3U};  // NaN as floats
    e.columns.push_back(tf::column::of<std::uint32_t>("rgb", colors));
    e.columns.back().type = tf::scalar_type::float32;
    return file;
}

}  // namespace

TEST_CASE("pcd: a file by hand, in each encoding") {
    const std::vector<tf::point3> points{{1, 2, 3}, {-0.5, 0, 4}};
    const std::string one = raw(1.0F) + raw(2.0F) + raw(3.0F);
    const std::string two = raw(-0.5F) + raw(0.0F) + raw(4.0F);
    CHECK(read_pcd(xyz_head(2, "ascii") + "1 2 3\n-0.5 0 4\n").mesh.points == points);
    CHECK(read_pcd(xyz_head(2, "binary") + one + two).mesh.points == points);
    // A block a field, here as literals: 23 is a run of 24.
    const std::string blocks =
        raw(1.0F) + raw(-0.5F) + raw(2.0F) + raw(0.0F) + raw(3.0F) + raw(4.0F);
    const std::string lengths = raw(std::uint32_t{25}) + raw(std::uint32_t{24});
    const tf::mesh_file file =
        read_pcd(xyz_head(2, "binary_compressed") + lengths + "\x17" + blocks);
    CHECK(file.mesh.points == points);
    CHECK(file.format == "pcd-binary-compressed");
    CHECK(file.stored_as == tf::precision::float32);
    CHECK(file.attributes.comments.empty());
    CHECK(file.attributes.obj_info.empty());
}

TEST_CASE("pcd: a header may be old, in another order, with CRLF, or without its first comment") {
    for (const std::string text :
         {"VERSION .5\nCOLUMNS x y z\nPOINTS 1\nDATA ascii\n1 2 3\n",
          "VERSION 0.7\r\nFIELDS x y z\r\nSIZE 8 8 8\r\nWIDTH 1\r\nHEIGHT 1\r\nDATA ascii\r\n1 2 "
          "3\r\n",
          "# hello\n# .PCD v.7\nVERSION .7\nFIELDS z x y\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
          "POINTS 1\nHEIGHT 1\nWIDTH 1\nDATA ascii\n3 1 2\n"}) {
        CAPTURE(text);
        CHECK(read_pcd(text).mesh.points == std::vector<tf::point3>{{1, 2, 3}});
        CHECK(read_pcd(text, "stdin").format == "pcd-ascii");
    }
    CHECK(read_pcd("# hello\n# .PCD v.7\nVERSION .7\nFIELDS x y z\nPOINTS 0\nDATA ascii\n")
              .attributes.comments == std::vector<std::string>{"hello"});
}

TEST_CASE("pcd: every type, count and bit survives in each encoding, and again") {
    tf::mesh_file file = rich();
    for (const char* const as : {"", "pcd-binary-compressed"})
        for (const bool ascii : {false, true}) {
            CAPTURE(as);
            CAPTURE(ascii);
            file.format = as;
            const std::string bytes = written_pcd(file, "pcd", ascii);
            const tf::mesh_file again = read_pcd(bytes);
            CHECK(written_pcd(again, "pcd", ascii) == bytes);
            REQUIRE(again.mesh.points.size() == 3);
            CHECK(std::isnan(again.mesh.points[1].y));
            CHECK(std::signbit(again.mesh.points[0].y));
            CHECK(again.mesh.points[2] == file.mesh.points[2]);
            REQUIRE(vertices_of(again).columns.size() == 3 + vertices_of(file).columns.size());
            for (std::size_t i = 0; i < vertices_of(file).columns.size(); ++i) {
                const tf::column& before = vertices_of(file).columns[i];
                const tf::column& after = vertices_of(again).columns[i + 3];
                CAPTURE(before.name);
                CHECK(after.name == before.name);
                CHECK(after.values == before.values);
                CHECK((after.type == before.type || (ascii && before.name == "rgb")));
            }
        }
    const std::string header = written_pcd(file, "pcd", true).substr(0, 400);
    CHECK(holds(header, " f8 fpfh odd[1] alone[0] rgb\n"));
    CHECK(holds(header, "COUNT 1 1 1 1 1 1 1 1 1 1 1 1 1 3 1 1 1\n"));
}

TEST_CASE("pcd: types keep their bits through PLY, 64-bit integers too") {
    const tf::mesh_file file = rich();
    const tf::mesh_file binary = read_pcd(written_pcd(file, "ply"), "a.ply");
    const tf::mesh_file text = read_pcd(written_pcd(file, "ply", true), "a.ply");
    for (const tf::column& c : vertices_of(file).columns) {
        CAPTURE(c.name);
        CHECK(column_of(binary, c.name) == c);
        if (c.name != "rgb") CHECK(column_of(text, c.name) == c);
    }
}

TEST_CASE("pcd: an organized cloud and its viewpoint pass through PCD and PLY") {
    std::string text =
        "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\n"
        "HEIGHT 2\nVIEWPOINT 0.1 2 3 1 0 0 0\nPOINTS 4\nDATA ascii\n"
        "1 2 3\nnan nan nan\n4 5 6\n7 8 9\n";
    tf::mesh_file file = read_pcd(text);
    CHECK(file.mesh.points.size() == 4);
    const std::string shape = "WIDTH 2\nHEIGHT 2\nVIEWPOINT 0.1 2 3 1 0 0 0\nPOINTS 4\n";
    CHECK(holds(written_pcd(file, "pcd"), shape));
    CHECK(holds(written_pcd(read_pcd(written_pcd(file, "ply"), "a.ply"), "pcd"), shape));
    // With a point less they are no grid any more, and that is said.
    file.mesh.points.pop_back();
    file.attributes.elements.clear();
    const auto result = tf::write("/dev/null", file, {.format = "pcd"});
    CHECK(result.warnings.at(0).code == "organization");
    CHECK(holds(written_pcd(file, "pcd"), "WIDTH 3\nHEIGHT 1\n"));
}

TEST_CASE("pcd: padding between the fields is no column") {
    const std::string bytes =
        head("x y z _ i _", "4 4 4 1 2 8", "F F F U U I", "1 1 1 3 1 2", 2, "binary") + raw(1.0F) +
        raw(2.0F) + raw(3.0F) + "abc" + raw(std::uint16_t{7}) + std::string(16, 'x') + raw(4.0F) +
        raw(5.0F) + raw(6.0F) + "abc" + raw(std::uint16_t{8}) + std::string(16, 'x');
    const tf::mesh_file file = read_pcd(bytes);
    CHECK(file.mesh.points == std::vector<tf::point3>{{1, 2, 3}, {4, 5, 6}});
    CHECK(vertices_of(file).columns.size() == 4);
    CHECK(column_of(file, "i").number(1) == 8);
}

TEST_CASE("pcd: headers that lie are refused with line or byte") {
    CHECK(holds(pcd_complaint(xyz_head(2, "ascii") + "1 2 3\n"), "announced"));
    CHECK(holds(pcd_complaint(xyz_head(1, "ascii") + "1.5 2.5\n"), "but the line ends"));
    CHECK(holds(pcd_complaint(xyz_head(1, "ascii") + "1 2 3 4\n"), "a.pcd:12: more values"));
    CHECK(holds(pcd_complaint(xyz_head(1, "ascii") + "1 b 3\n"), "found 'b'"));
    CHECK(holds(pcd_complaint(xyz_head(4'000'000'000, "binary") + "123"), "4000000000 announced"));
    CHECK(holds(pcd_complaint(xyz_head(2, "tar") + "123"), "a.pcd:11: unknown encoding"));
    CHECK(holds(pcd_complaint(head("x y", "4 4", "F F", "1 1", 0, "ascii")), "no field z"));
    CHECK(
        holds(pcd_complaint(head("x y z", "4 4 4", "F F", "1 1 1", 0, "ascii")), "a.pcd:5: fewer"));
    CHECK(holds(pcd_complaint(head("x y z", "4 4 4", "F F F F", "1 1 1", 0, "ascii")),
                "a.pcd:5: more"));
    CHECK(holds(pcd_complaint(head("x y z", "4 4 3", "F F F", "1 1 1", 0, "ascii")), "3 bytes"));
    CHECK(holds(pcd_complaint(head("x y z", "4 4 4", "F F Q", "1 1 1", 0, "ascii")),
                "expected type I, U or F"));
    CHECK(holds(pcd_complaint(head("x y z h", "4 4 4 4", "F F F F", "1 1 1 99999", 0, "ascii")),
                "a.pcd:6: expected a number from 0"));
    CHECK(holds(pcd_complaint("VERSION .7\nFIELDS x y z\nDATA ascii\n"),
                "does not have the number of points"));
    CHECK(
        holds(pcd_complaint("VERSION .7\nFIELDS x y z\nWIDTH 3\nHEIGHT 2\nPOINTS 5\nDATA ascii\n"),
              "POINTS is 5"));
    CHECK(
        holds(pcd_complaint("VERSION .7\nFIELDS x y z\nWIDTH 1000000000000\nHEIGHT 1000000000000\n"
                            "DATA ascii\n"),
              "announced"));
    CHECK(holds(pcd_complaint("VERSION .7\nFIELDS x y z\n"), "without 'DATA'"));
    const auto packed_file = [&](std::uint32_t there, std::uint32_t size, const std::string& data) {
        return pcd_complaint(xyz_head(2, "binary_compressed") + raw(there) + raw(size) + data);
    };
    CHECK(holds(packed_file(9, 24, "\x17"s), "bytes announced"));
    CHECK(holds(packed_file(1, 25, "\x17"s), "do not match 2 points"));
    CHECK(holds(packed_file(1, 24, "\x17"s), "damaged"));
    CHECK(holds(packed_file(3, 24, "\x00\x61\x20"s), "damaged"));
    CHECK(holds(pcd_complaint(xyz_head(300'000'000, "binary_compressed") + raw(std::uint32_t{3}) +
                              raw(std::uint32_t{3'600'000'000}) + "abc"),
                "announced size"));
    CHECK(holds(pcd_complaint(xyz_head(2, "binary_compressed") + "1234567"), "lengths"));
    CHECK(read_pcd(xyz_head(1, "binary") + std::string(13, 'x')).warnings.at(0).code ==
          "trailing-bytes");
}

TEST_CASE("pcd: faces and lists are left out with a warning, and doubles stay doubles") {
    tf::mesh_file file = read_pcd(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nproperty list uchar int tags\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n0.1 0 0 0\n1 0 0 2 3 4\n0 1 0 0\n"
        "3 0 1 2\n",
        "a.ply");
    const auto result = tf::write("/dev/null", file, {.format = "pcd"});
    CHECK(result.warnings.at(0).code == "columns-dropped");
    CHECK(result.warnings.at(1).code == "faces-dropped");
    CHECK(result.written_as == tf::precision::float64);
    CHECK(read_pcd(written_pcd(file, "pcd")).mesh.points == file.mesh.points);
    CHECK(read_pcd(written_pcd(file, "pcd", true)).mesh.points == file.mesh.points);
}

TEST_CASE("lzf: what is packed comes back, runs and noise and everything between") {
    std::mt19937 random(5);
    for (const std::size_t size :
         std::vector<std::size_t>{0,   1,   2,   3,    4,    31,   32,   33,   263,    264,
                                  265, 266, 267, 8191, 8192, 8193, 8194, 8195, 20'000, 100'000}) {
        for (const unsigned letters : {1U, 2U, 5U, 256U}) {
            CAPTURE(size);
            CAPTURE(letters);
            std::string bytes(size, '\0');
            for (char& c : bytes) c = static_cast<char>(random() % letters);
            const std::string small = packed_pcd(bytes);
            CHECK(unpacked(small, size) == bytes);
            if (letters == 1 && size > 1000) CHECK(small.size() < size / 50);
            // A repetition from exactly as far back as it can be, and from one further.
            for (const std::size_t back : {std::size_t{8192}, std::size_t{8193}}) {
                if (size < 3 || size > back) continue;
                const std::string twice = bytes + std::string(back - size, 'x') + bytes;
                CHECK(unpacked(packed_pcd(twice), twice.size()) == twice);
            }
        }
    }
}

TEST_CASE("lzf: copies overlap themselves, and damaged bytes are refused") {
    CHECK(unpacked("\x00"
                   "a"
                   "\x20\x00"s,
                   4) == "aaaa");
    CHECK(unpacked("\x01"
                   "ab"
                   "\x60\x01"s,
                   7) == "abababa");
    CHECK(unpacked("\x00"
                   "a"
                   "\xe0\x01\x00"s,
                   11) == "aaaaaaaaaaa");
    CHECK(unpacked("\x00"
                   "a"
                   "\x20\x01"s,
                   4) == "?");  // ahead of the first byte
    CHECK(unpacked("\x00"
                   "a"
                   "\x20"s,
                   4) == "?");  // cut
    CHECK(unpacked("\x00"
                   "a"
                   "\xe0\x01"s,
                   11) == "?");  // cut
    CHECK(unpacked("\x02"
                   "ab"s,
                   3) == "?");  // cut
    CHECK(unpacked("\x00"
                   "a"
                   "\x20\x00"s,
                   3) == "?");  // more than there is room for
    CHECK(unpacked("\x00"
                   "a"
                   "\x20\x00"s,
                   5) == "?");  // less than promised
}
